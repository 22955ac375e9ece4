/* io_ply.h: the PLY reader: polygons and triangle strips with normals, and with colours and textures per vertex or
 * face. */
#ifndef IO_PLY_H
#define IO_PLY_H

#include "model_build.h"

/* ply_begins: whether the first line is that of a PLY file. */
int ply_begins(const uint8_t *data, size_t size);

/* ply_load: loads PLY 1.0, text or binary in either byte order. Makes a mesh, an instance and a double-sided material
 * for each texture (comment TextureFile), and one more for faces without a texture. Returns 1, or 0 with b->r set. */
int ply_load(model_build *b, const uint8_t *data, size_t size);

#endif

/* records.h: the words of a .lmp's records -> the library's structs. Layer 1. */
#ifndef LMB_BASE_RECORDS_H
#define LMB_BASE_RECORDS_H

#include <lambent/pack.h>

/* Record i of a part that has records. */
const uint32_t *lmb_pack_record(const lmb_pack *pack, int kind, uint32_t i);

/* Reads words as floats. */
float lmb_pack_float(const uint32_t *word);
lmb_vec3 lmb_pack_vec(const uint32_t *word);

/* Words per entry of each kind; 0: the kind has no records. */
extern const uint8_t lmb_pack_words_each[LMB_PACK_KINDS];

/* Convert one record to a struct; pointers refer to the file. */
void lmb_pack_take_mesh(lmb_mesh *out, const lmb_pack *pack, uint32_t i);
void lmb_pack_take_material(lmb_material *out, const lmb_pack *pack, uint32_t i);
void lmb_pack_take_texture(lmb_texture *out, const lmb_pack *pack, uint32_t i);
void lmb_pack_take_matrix(lmb_mat4 *out, const uint32_t *word);
void lmb_pack_take_light(lmb_light *out, const lmb_pack *pack, uint32_t i);
void lmb_pack_take_bounds(lmb_scene *out, const lmb_pack *pack);

/* Node words in the records of instances, lights and cameras. */
enum { PACK_INSTANCE_NODE = 14, PACK_LIGHT_NODE = 12, PACK_CAMERA_NODE = 19 };

#endif

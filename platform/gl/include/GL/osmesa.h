/* osmesa.h: contexts that draw into memory: names and numbers of OSMesa, as lambent offers them. */
#ifndef LAMBENT_OSMESA_H
#define LAMBENT_OSMESA_H
#define OSMESA_H

#include "gl.h"

#define OSMESA_MAJOR_VERSION 11
#define OSMESA_MINOR_VERSION 2
#define OSMESA_PATCH_VERSION 0

/* Formats. RGBA, BGRA and ARGB name bytes in memory, on every byte order. */
#define OSMESA_COLOR_INDEX 0x1900
#define OSMESA_RGBA        0x1908
#define OSMESA_BGRA        0x1
#define OSMESA_ARGB        0x2
#define OSMESA_RGB         0x1907
#define OSMESA_BGR         0x4
#define OSMESA_RGB_565     0x5

#define OSMESA_ROW_LENGTH      0x10
#define OSMESA_Y_UP            0x11
#define OSMESA_WIDTH           0x20
#define OSMESA_HEIGHT          0x21
#define OSMESA_FORMAT          0x22
#define OSMESA_TYPE            0x23
#define OSMESA_MAX_WIDTH       0x24
#define OSMESA_MAX_HEIGHT      0x25
#define OSMESA_DEPTH_BITS      0x30
#define OSMESA_STENCIL_BITS    0x31
#define OSMESA_ACCUM_BITS      0x32
#define OSMESA_PROFILE         0x33
#define OSMESA_CORE_PROFILE    0x34
#define OSMESA_COMPAT_PROFILE  0x35
#define OSMESA_CONTEXT_MAJOR_VERSION 0x36
#define OSMESA_CONTEXT_MINOR_VERSION 0x37

#ifdef __cplusplus
extern "C" {
#endif

typedef struct osmesa_context *OSMesaContext;
typedef void (*OSMESAproc)(void);

GLAPI OSMesaContext APIENTRY OSMesaCreateContext(GLenum format, OSMesaContext sharelist);
GLAPI OSMesaContext APIENTRY OSMesaCreateContextExt(GLenum format, GLint depthBits, GLint stencilBits, GLint accumBits,
                                                    OSMesaContext sharelist);
GLAPI OSMesaContext APIENTRY OSMesaCreateContextAttribs(const int *attribList, OSMesaContext sharelist);
GLAPI void APIENTRY OSMesaDestroyContext(OSMesaContext ctx);
GLAPI GLboolean APIENTRY OSMesaMakeCurrent(OSMesaContext ctx, void *buffer, GLenum type, GLsizei width,
                                           GLsizei height);
GLAPI OSMesaContext APIENTRY OSMesaGetCurrentContext(void);
GLAPI void APIENTRY OSMesaPixelStore(GLint pname, GLint value);
GLAPI void APIENTRY OSMesaGetIntegerv(GLint pname, GLint *value);
GLAPI GLboolean APIENTRY OSMesaGetDepthBuffer(OSMesaContext c, GLint *width, GLint *height, GLint *bytesPerValue,
                                              void **buffer);
GLAPI GLboolean APIENTRY OSMesaGetColorBuffer(OSMesaContext c, GLint *width, GLint *height, GLint *format,
                                              void **buffer);
GLAPI OSMESAproc APIENTRY OSMesaGetProcAddress(const char *funcName);
GLAPI void APIENTRY OSMesaColorClamp(GLboolean enable);
GLAPI void APIENTRY OSMesaPostprocess(OSMesaContext osmesa, const char *filter, unsigned enable_value);

#ifdef __cplusplus
}
#endif
#endif

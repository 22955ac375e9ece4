/* gl.h: OpenGL 1.0 to 1.5 and some extensions, as lambent offers them: names and numbers of the specification.
 *
 * platform/gl/README.md lists the calls that draw. The others set GL_INVALID_OPERATION. */
#ifndef LAMBENT_GL_H
#define LAMBENT_GL_H
#define __gl_h_
#define __GL_H__

#include <stddef.h>
#include <stdint.h>

#ifndef GLAPI
#define GLAPI extern
#endif
#ifndef APIENTRY
#define APIENTRY
#endif
#ifndef GLAPIENTRY
#define GLAPIENTRY APIENTRY
#endif
#ifndef APIENTRYP
#define APIENTRYP APIENTRY *
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef unsigned int GLenum;
typedef unsigned char GLboolean;
typedef unsigned int GLbitfield;
typedef void GLvoid;
typedef int8_t GLbyte;
typedef int16_t GLshort;
typedef int32_t GLint;
typedef uint8_t GLubyte;
typedef uint16_t GLushort;
typedef uint32_t GLuint;
typedef int32_t GLsizei;
typedef float GLfloat;
typedef float GLclampf;
typedef double GLdouble;
typedef double GLclampd;
typedef char GLchar;
typedef char GLcharARB;
typedef ptrdiff_t GLintptr;
typedef ptrdiff_t GLsizeiptr;
typedef ptrdiff_t GLintptrARB;
typedef ptrdiff_t GLsizeiptrARB;

#define GL_VERSION_1_1 1
#define GL_VERSION_1_2 1
#define GL_VERSION_1_3 1
#define GL_VERSION_1_4 1
#define GL_VERSION_1_5 1
#define GL_EXT_framebuffer_object 1
#define GL_EXT_packed_depth_stencil 1
#define GL_EXT_bgra 1
#define GL_EXT_texture_lod_bias 1
#define GL_EXT_blend_color 1
#define GL_EXT_blend_minmax 1
#define GL_EXT_blend_subtract 1
#define GL_EXT_blend_func_separate 1
#define GL_EXT_fog_coord 1
#define GL_EXT_secondary_color 1
#define GL_EXT_stencil_wrap 1
#define GL_EXT_abgr 1
#define GL_EXT_texture_env_combine 1
#define GL_EXT_texture_filter_anisotropic 1
#define GL_EXT_compiled_vertex_array 1
#define GL_EXT_draw_range_elements 1
#define GL_EXT_multi_draw_arrays 1
#define GL_EXT_point_parameters 1
#define GL_EXT_polygon_offset 1
#define GL_EXT_texture_object 1
#define GL_EXT_vertex_array 1
#define GL_EXT_rescale_normal 1
#define GL_EXT_separate_specular_color 1
#define GL_EXT_texture_cube_map 1
#define GL_EXT_texture_env_add 1
#define GL_EXT_shadow_funcs 1
#define GL_EXT_copy_texture 1
#define GL_EXT_subtexture 1
#define GL_EXT_texture 1
#define GL_EXT_blend_logic_op 1
#define GL_EXT_texture_compression_s3tc 1
#define GL_ARB_multitexture 1
#define GL_ARB_vertex_buffer_object 1
#define GL_ARB_occlusion_query 1
#define GL_ARB_point_parameters 1
#define GL_ARB_depth_texture 1
#define GL_ARB_shadow 1
#define GL_ARB_texture_border_clamp 1
#define GL_ARB_texture_cube_map 1
#define GL_ARB_texture_env_combine 1
#define GL_ARB_texture_env_dot3 1
#define GL_ARB_texture_mirrored_repeat 1
#define GL_ARB_transpose_matrix 1
#define GL_ARB_window_pos 1
#define GL_ARB_multisample 1
#define GL_ARB_texture_compression 1
#define GL_ARB_texture_rectangle 1
#define GL_ARB_point_sprite 1

#define GL_FALSE                                     0x0000
#define GL_NONE                                      0x0000
#define GL_NO_ERROR                                  0x0000
#define GL_POINTS                                    0x0000
#define GL_ZERO                                      0x0000
#define GL_CLIENT_PIXEL_STORE_BIT                    0x0001
#define GL_CURRENT_BIT                               0x0001
#define GL_LINES                                     0x0001
#define GL_OES_EGL_image                             0x0001
#define GL_ONE                                       0x0001
#define GL_TRUE                                      0x0001
#define GL_CLIENT_VERTEX_ARRAY_BIT                   0x0002
#define GL_LINE_LOOP                                 0x0002
#define GL_POINT_BIT                                 0x0002
#define GL_LINE_STRIP                                0x0003
#define GL_LINE_BIT                                  0x0004
#define GL_TRIANGLES                                 0x0004
#define GL_TRIANGLE_STRIP                            0x0005
#define GL_TRIANGLE_FAN                              0x0006
#define GL_QUADS                                     0x0007
#define GL_POLYGON_BIT                               0x0008
#define GL_QUAD_STRIP                                0x0008
#define GL_POLYGON                                   0x0009
#define GL_POLYGON_STIPPLE_BIT                       0x0010
#define GL_PIXEL_MODE_BIT                            0x0020
#define GL_LIGHTING_BIT                              0x0040
#define GL_FOG_BIT                                   0x0080
#define GL_ACCUM                                     0x0100
#define GL_DEPTH_BUFFER_BIT                          0x0100
#define GL_LOAD                                      0x0101
#define GL_RETURN                                    0x0102
#define GL_MULT                                      0x0103
#define GL_ADD                                       0x0104
#define GL_ACCUM_BUFFER_BIT                          0x0200
#define GL_NEVER                                     0x0200
#define GL_LESS                                      0x0201
#define GL_EQUAL                                     0x0202
#define GL_LEQUAL                                    0x0203
#define GL_GREATER                                   0x0204
#define GL_NOTEQUAL                                  0x0205
#define GL_GEQUAL                                    0x0206
#define GL_ALWAYS                                    0x0207
#define GL_SRC_COLOR                                 0x0300
#define GL_ONE_MINUS_SRC_COLOR                       0x0301
#define GL_SRC_ALPHA                                 0x0302
#define GL_ONE_MINUS_SRC_ALPHA                       0x0303
#define GL_DST_ALPHA                                 0x0304
#define GL_ONE_MINUS_DST_ALPHA                       0x0305
#define GL_DST_COLOR                                 0x0306
#define GL_ONE_MINUS_DST_COLOR                       0x0307
#define GL_SRC_ALPHA_SATURATE                        0x0308
#define GL_FRONT_LEFT                                0x0400
#define GL_STENCIL_BUFFER_BIT                        0x0400
#define GL_FRONT_RIGHT                               0x0401
#define GL_BACK_LEFT                                 0x0402
#define GL_BACK_RIGHT                                0x0403
#define GL_FRONT                                     0x0404
#define GL_BACK                                      0x0405
#define GL_LEFT                                      0x0406
#define GL_RIGHT                                     0x0407
#define GL_FRONT_AND_BACK                            0x0408
#define GL_AUX0                                      0x0409
#define GL_AUX1                                      0x040A
#define GL_AUX2                                      0x040B
#define GL_AUX3                                      0x040C
#define GL_INVALID_ENUM                              0x0500
#define GL_INVALID_VALUE                             0x0501
#define GL_INVALID_OPERATION                         0x0502
#define GL_STACK_OVERFLOW                            0x0503
#define GL_STACK_UNDERFLOW                           0x0504
#define GL_OUT_OF_MEMORY                             0x0505
#define GL_INVALID_FRAMEBUFFER_OPERATION_EXT         0x0506
#define GL_2D                                        0x0600
#define GL_3D                                        0x0601
#define GL_3D_COLOR                                  0x0602
#define GL_3D_COLOR_TEXTURE                          0x0603
#define GL_4D_COLOR_TEXTURE                          0x0604
#define GL_PASS_THROUGH_TOKEN                        0x0700
#define GL_POINT_TOKEN                               0x0701
#define GL_LINE_TOKEN                                0x0702
#define GL_POLYGON_TOKEN                             0x0703
#define GL_BITMAP_TOKEN                              0x0704
#define GL_DRAW_PIXEL_TOKEN                          0x0705
#define GL_COPY_PIXEL_TOKEN                          0x0706
#define GL_LINE_RESET_TOKEN                          0x0707
#define GL_EXP                                       0x0800
#define GL_VIEWPORT_BIT                              0x0800
#define GL_EXP2                                      0x0801
#define GL_CW                                        0x0900
#define GL_CCW                                       0x0901
#define GL_COEFF                                     0x0A00
#define GL_ORDER                                     0x0A01
#define GL_DOMAIN                                    0x0A02
#define GL_CURRENT_COLOR                             0x0B00
#define GL_CURRENT_INDEX                             0x0B01
#define GL_CURRENT_NORMAL                            0x0B02
#define GL_CURRENT_TEXTURE_COORDS                    0x0B03
#define GL_CURRENT_RASTER_COLOR                      0x0B04
#define GL_CURRENT_RASTER_INDEX                      0x0B05
#define GL_CURRENT_RASTER_TEXTURE_COORDS             0x0B06
#define GL_CURRENT_RASTER_POSITION                   0x0B07
#define GL_CURRENT_RASTER_POSITION_VALID             0x0B08
#define GL_CURRENT_RASTER_DISTANCE                   0x0B09
#define GL_POINT_SMOOTH                              0x0B10
#define GL_POINT_SIZE                                0x0B11
#define GL_POINT_SIZE_RANGE                          0x0B12
#define GL_SMOOTH_POINT_SIZE_RANGE                   0x0B12
#define GL_POINT_SIZE_GRANULARITY                    0x0B13
#define GL_SMOOTH_POINT_SIZE_GRANULARITY             0x0B13
#define GL_LINE_SMOOTH                               0x0B20
#define GL_LINE_WIDTH                                0x0B21
#define GL_LINE_WIDTH_RANGE                          0x0B22
#define GL_SMOOTH_LINE_WIDTH_RANGE                   0x0B22
#define GL_LINE_WIDTH_GRANULARITY                    0x0B23
#define GL_SMOOTH_LINE_WIDTH_GRANULARITY             0x0B23
#define GL_LINE_STIPPLE                              0x0B24
#define GL_LINE_STIPPLE_PATTERN                      0x0B25
#define GL_LINE_STIPPLE_REPEAT                       0x0B26
#define GL_LIST_MODE                                 0x0B30
#define GL_MAX_LIST_NESTING                          0x0B31
#define GL_LIST_BASE                                 0x0B32
#define GL_LIST_INDEX                                0x0B33
#define GL_POLYGON_MODE                              0x0B40
#define GL_POLYGON_SMOOTH                            0x0B41
#define GL_POLYGON_STIPPLE                           0x0B42
#define GL_EDGE_FLAG                                 0x0B43
#define GL_CULL_FACE                                 0x0B44
#define GL_CULL_FACE_MODE                            0x0B45
#define GL_FRONT_FACE                                0x0B46
#define GL_LIGHTING                                  0x0B50
#define GL_LIGHT_MODEL_LOCAL_VIEWER                  0x0B51
#define GL_LIGHT_MODEL_TWO_SIDE                      0x0B52
#define GL_LIGHT_MODEL_AMBIENT                       0x0B53
#define GL_SHADE_MODEL                               0x0B54
#define GL_COLOR_MATERIAL_FACE                       0x0B55
#define GL_COLOR_MATERIAL_PARAMETER                  0x0B56
#define GL_COLOR_MATERIAL                            0x0B57
#define GL_FOG                                       0x0B60
#define GL_FOG_INDEX                                 0x0B61
#define GL_FOG_DENSITY                               0x0B62
#define GL_FOG_START                                 0x0B63
#define GL_FOG_END                                   0x0B64
#define GL_FOG_MODE                                  0x0B65
#define GL_FOG_COLOR                                 0x0B66
#define GL_DEPTH_RANGE                               0x0B70
#define GL_DEPTH_TEST                                0x0B71
#define GL_DEPTH_WRITEMASK                           0x0B72
#define GL_DEPTH_CLEAR_VALUE                         0x0B73
#define GL_DEPTH_FUNC                                0x0B74
#define GL_ACCUM_CLEAR_VALUE                         0x0B80
#define GL_STENCIL_TEST                              0x0B90
#define GL_STENCIL_CLEAR_VALUE                       0x0B91
#define GL_STENCIL_FUNC                              0x0B92
#define GL_STENCIL_VALUE_MASK                        0x0B93
#define GL_STENCIL_FAIL                              0x0B94
#define GL_STENCIL_PASS_DEPTH_FAIL                   0x0B95
#define GL_STENCIL_PASS_DEPTH_PASS                   0x0B96
#define GL_STENCIL_REF                               0x0B97
#define GL_STENCIL_WRITEMASK                         0x0B98
#define GL_MATRIX_MODE                               0x0BA0
#define GL_NORMALIZE                                 0x0BA1
#define GL_VIEWPORT                                  0x0BA2
#define GL_MODELVIEW_STACK_DEPTH                     0x0BA3
#define GL_PROJECTION_STACK_DEPTH                    0x0BA4
#define GL_TEXTURE_STACK_DEPTH                       0x0BA5
#define GL_MODELVIEW_MATRIX                          0x0BA6
#define GL_PROJECTION_MATRIX                         0x0BA7
#define GL_TEXTURE_MATRIX                            0x0BA8
#define GL_ATTRIB_STACK_DEPTH                        0x0BB0
#define GL_CLIENT_ATTRIB_STACK_DEPTH                 0x0BB1
#define GL_ALPHA_TEST                                0x0BC0
#define GL_ALPHA_TEST_FUNC                           0x0BC1
#define GL_ALPHA_TEST_REF                            0x0BC2
#define GL_DITHER                                    0x0BD0
#define GL_BLEND_DST                                 0x0BE0
#define GL_BLEND_SRC                                 0x0BE1
#define GL_BLEND                                     0x0BE2
#define GL_LOGIC_OP_MODE                             0x0BF0
#define GL_INDEX_LOGIC_OP                            0x0BF1
#define GL_LOGIC_OP                                  0x0BF1
#define GL_COLOR_LOGIC_OP                            0x0BF2
#define GL_AUX_BUFFERS                               0x0C00
#define GL_DRAW_BUFFER                               0x0C01
#define GL_READ_BUFFER                               0x0C02
#define GL_SCISSOR_BOX                               0x0C10
#define GL_SCISSOR_TEST                              0x0C11
#define GL_INDEX_CLEAR_VALUE                         0x0C20
#define GL_INDEX_WRITEMASK                           0x0C21
#define GL_COLOR_CLEAR_VALUE                         0x0C22
#define GL_COLOR_WRITEMASK                           0x0C23
#define GL_INDEX_MODE                                0x0C30
#define GL_RGBA_MODE                                 0x0C31
#define GL_DOUBLEBUFFER                              0x0C32
#define GL_STEREO                                    0x0C33
#define GL_RENDER_MODE                               0x0C40
#define GL_PERSPECTIVE_CORRECTION_HINT               0x0C50
#define GL_POINT_SMOOTH_HINT                         0x0C51
#define GL_LINE_SMOOTH_HINT                          0x0C52
#define GL_POLYGON_SMOOTH_HINT                       0x0C53
#define GL_FOG_HINT                                  0x0C54
#define GL_TEXTURE_GEN_S                             0x0C60
#define GL_TEXTURE_GEN_T                             0x0C61
#define GL_TEXTURE_GEN_R                             0x0C62
#define GL_TEXTURE_GEN_Q                             0x0C63
#define GL_PIXEL_MAP_I_TO_I                          0x0C70
#define GL_PIXEL_MAP_S_TO_S                          0x0C71
#define GL_PIXEL_MAP_I_TO_R                          0x0C72
#define GL_PIXEL_MAP_I_TO_G                          0x0C73
#define GL_PIXEL_MAP_I_TO_B                          0x0C74
#define GL_PIXEL_MAP_I_TO_A                          0x0C75
#define GL_PIXEL_MAP_R_TO_R                          0x0C76
#define GL_PIXEL_MAP_G_TO_G                          0x0C77
#define GL_PIXEL_MAP_B_TO_B                          0x0C78
#define GL_PIXEL_MAP_A_TO_A                          0x0C79
#define GL_PIXEL_MAP_I_TO_I_SIZE                     0x0CB0
#define GL_PIXEL_MAP_S_TO_S_SIZE                     0x0CB1
#define GL_PIXEL_MAP_I_TO_R_SIZE                     0x0CB2
#define GL_PIXEL_MAP_I_TO_G_SIZE                     0x0CB3
#define GL_PIXEL_MAP_I_TO_B_SIZE                     0x0CB4
#define GL_PIXEL_MAP_I_TO_A_SIZE                     0x0CB5
#define GL_PIXEL_MAP_R_TO_R_SIZE                     0x0CB6
#define GL_PIXEL_MAP_G_TO_G_SIZE                     0x0CB7
#define GL_PIXEL_MAP_B_TO_B_SIZE                     0x0CB8
#define GL_PIXEL_MAP_A_TO_A_SIZE                     0x0CB9
#define GL_UNPACK_SWAP_BYTES                         0x0CF0
#define GL_UNPACK_LSB_FIRST                          0x0CF1
#define GL_UNPACK_ROW_LENGTH                         0x0CF2
#define GL_UNPACK_SKIP_ROWS                          0x0CF3
#define GL_UNPACK_SKIP_PIXELS                        0x0CF4
#define GL_UNPACK_ALIGNMENT                          0x0CF5
#define GL_PACK_SWAP_BYTES                           0x0D00
#define GL_PACK_LSB_FIRST                            0x0D01
#define GL_PACK_ROW_LENGTH                           0x0D02
#define GL_PACK_SKIP_ROWS                            0x0D03
#define GL_PACK_SKIP_PIXELS                          0x0D04
#define GL_PACK_ALIGNMENT                            0x0D05
#define GL_MAP_COLOR                                 0x0D10
#define GL_MAP_STENCIL                               0x0D11
#define GL_INDEX_SHIFT                               0x0D12
#define GL_INDEX_OFFSET                              0x0D13
#define GL_RED_SCALE                                 0x0D14
#define GL_RED_BIAS                                  0x0D15
#define GL_ZOOM_X                                    0x0D16
#define GL_ZOOM_Y                                    0x0D17
#define GL_GREEN_SCALE                               0x0D18
#define GL_GREEN_BIAS                                0x0D19
#define GL_BLUE_SCALE                                0x0D1A
#define GL_BLUE_BIAS                                 0x0D1B
#define GL_ALPHA_SCALE                               0x0D1C
#define GL_ALPHA_BIAS                                0x0D1D
#define GL_DEPTH_SCALE                               0x0D1E
#define GL_DEPTH_BIAS                                0x0D1F
#define GL_MAX_EVAL_ORDER                            0x0D30
#define GL_MAX_LIGHTS                                0x0D31
#define GL_MAX_CLIP_PLANES                           0x0D32
#define GL_MAX_TEXTURE_SIZE                          0x0D33
#define GL_MAX_PIXEL_MAP_TABLE                       0x0D34
#define GL_MAX_ATTRIB_STACK_DEPTH                    0x0D35
#define GL_MAX_MODELVIEW_STACK_DEPTH                 0x0D36
#define GL_MAX_NAME_STACK_DEPTH                      0x0D37
#define GL_MAX_PROJECTION_STACK_DEPTH                0x0D38
#define GL_MAX_TEXTURE_STACK_DEPTH                   0x0D39
#define GL_MAX_VIEWPORT_DIMS                         0x0D3A
#define GL_MAX_CLIENT_ATTRIB_STACK_DEPTH             0x0D3B
#define GL_SUBPIXEL_BITS                             0x0D50
#define GL_INDEX_BITS                                0x0D51
#define GL_RED_BITS                                  0x0D52
#define GL_GREEN_BITS                                0x0D53
#define GL_BLUE_BITS                                 0x0D54
#define GL_ALPHA_BITS                                0x0D55
#define GL_DEPTH_BITS                                0x0D56
#define GL_STENCIL_BITS                              0x0D57
#define GL_ACCUM_RED_BITS                            0x0D58
#define GL_ACCUM_GREEN_BITS                          0x0D59
#define GL_ACCUM_BLUE_BITS                           0x0D5A
#define GL_ACCUM_ALPHA_BITS                          0x0D5B
#define GL_NAME_STACK_DEPTH                          0x0D70
#define GL_AUTO_NORMAL                               0x0D80
#define GL_MAP1_COLOR_4                              0x0D90
#define GL_MAP1_INDEX                                0x0D91
#define GL_MAP1_NORMAL                               0x0D92
#define GL_MAP1_TEXTURE_COORD_1                      0x0D93
#define GL_MAP1_TEXTURE_COORD_2                      0x0D94
#define GL_MAP1_TEXTURE_COORD_3                      0x0D95
#define GL_MAP1_TEXTURE_COORD_4                      0x0D96
#define GL_MAP1_VERTEX_3                             0x0D97
#define GL_MAP1_VERTEX_4                             0x0D98
#define GL_MAP2_COLOR_4                              0x0DB0
#define GL_MAP2_INDEX                                0x0DB1
#define GL_MAP2_NORMAL                               0x0DB2
#define GL_MAP2_TEXTURE_COORD_1                      0x0DB3
#define GL_MAP2_TEXTURE_COORD_2                      0x0DB4
#define GL_MAP2_TEXTURE_COORD_3                      0x0DB5
#define GL_MAP2_TEXTURE_COORD_4                      0x0DB6
#define GL_MAP2_VERTEX_3                             0x0DB7
#define GL_MAP2_VERTEX_4                             0x0DB8
#define GL_MAP1_GRID_DOMAIN                          0x0DD0
#define GL_MAP1_GRID_SEGMENTS                        0x0DD1
#define GL_MAP2_GRID_DOMAIN                          0x0DD2
#define GL_MAP2_GRID_SEGMENTS                        0x0DD3
#define GL_TEXTURE_1D                                0x0DE0
#define GL_TEXTURE_2D                                0x0DE1
#define GL_FEEDBACK_BUFFER_POINTER                   0x0DF0
#define GL_FEEDBACK_BUFFER_SIZE                      0x0DF1
#define GL_FEEDBACK_BUFFER_TYPE                      0x0DF2
#define GL_SELECTION_BUFFER_POINTER                  0x0DF3
#define GL_SELECTION_BUFFER_SIZE                     0x0DF4
#define GL_TEXTURE_WIDTH                             0x1000
#define GL_TRANSFORM_BIT                             0x1000
#define GL_TEXTURE_HEIGHT                            0x1001
#define GL_TEXTURE_COMPONENTS                        0x1003
#define GL_TEXTURE_INTERNAL_FORMAT                   0x1003
#define GL_TEXTURE_BORDER_COLOR                      0x1004
#define GL_TEXTURE_BORDER                            0x1005
#define GL_DONT_CARE                                 0x1100
#define GL_FASTEST                                   0x1101
#define GL_NICEST                                    0x1102
#define GL_AMBIENT                                   0x1200
#define GL_DIFFUSE                                   0x1201
#define GL_SPECULAR                                  0x1202
#define GL_POSITION                                  0x1203
#define GL_SPOT_DIRECTION                            0x1204
#define GL_SPOT_EXPONENT                             0x1205
#define GL_SPOT_CUTOFF                               0x1206
#define GL_CONSTANT_ATTENUATION                      0x1207
#define GL_LINEAR_ATTENUATION                        0x1208
#define GL_QUADRATIC_ATTENUATION                     0x1209
#define GL_COMPILE                                   0x1300
#define GL_COMPILE_AND_EXECUTE                       0x1301
#define GL_BYTE                                      0x1400
#define GL_UNSIGNED_BYTE                             0x1401
#define GL_SHORT                                     0x1402
#define GL_UNSIGNED_SHORT                            0x1403
#define GL_INT                                       0x1404
#define GL_UNSIGNED_INT                              0x1405
#define GL_FLOAT                                     0x1406
#define GL_2_BYTES                                   0x1407
#define GL_3_BYTES                                   0x1408
#define GL_4_BYTES                                   0x1409
#define GL_DOUBLE                                    0x140A
#define GL_CLEAR                                     0x1500
#define GL_AND                                       0x1501
#define GL_AND_REVERSE                               0x1502
#define GL_COPY                                      0x1503
#define GL_AND_INVERTED                              0x1504
#define GL_NOOP                                      0x1505
#define GL_XOR                                       0x1506
#define GL_OR                                        0x1507
#define GL_NOR                                       0x1508
#define GL_EQUIV                                     0x1509
#define GL_INVERT                                    0x150A
#define GL_OR_REVERSE                                0x150B
#define GL_COPY_INVERTED                             0x150C
#define GL_OR_INVERTED                               0x150D
#define GL_NAND                                      0x150E
#define GL_SET                                       0x150F
#define GL_EMISSION                                  0x1600
#define GL_SHININESS                                 0x1601
#define GL_AMBIENT_AND_DIFFUSE                       0x1602
#define GL_COLOR_INDEXES                             0x1603
#define GL_MODELVIEW                                 0x1700
#define GL_PROJECTION                                0x1701
#define GL_TEXTURE                                   0x1702
#define GL_COLOR                                     0x1800
#define GL_DEPTH                                     0x1801
#define GL_STENCIL                                   0x1802
#define GL_COLOR_INDEX                               0x1900
#define GL_STENCIL_INDEX                             0x1901
#define GL_DEPTH_COMPONENT                           0x1902
#define GL_RED                                       0x1903
#define GL_GREEN                                     0x1904
#define GL_BLUE                                      0x1905
#define GL_ALPHA                                     0x1906
#define GL_RGB                                       0x1907
#define GL_RGBA                                      0x1908
#define GL_LUMINANCE                                 0x1909
#define GL_LUMINANCE_ALPHA                           0x190A
#define GL_BITMAP                                    0x1A00
#define GL_POINT                                     0x1B00
#define GL_LINE                                      0x1B01
#define GL_FILL                                      0x1B02
#define GL_RENDER                                    0x1C00
#define GL_FEEDBACK                                  0x1C01
#define GL_SELECT                                    0x1C02
#define GL_FLAT                                      0x1D00
#define GL_SMOOTH                                    0x1D01
#define GL_KEEP                                      0x1E00
#define GL_REPLACE                                   0x1E01
#define GL_INCR                                      0x1E02
#define GL_DECR                                      0x1E03
#define GL_VENDOR                                    0x1F00
#define GL_RENDERER                                  0x1F01
#define GL_VERSION                                   0x1F02
#define GL_EXTENSIONS                                0x1F03
#define GL_ENABLE_BIT                                0x2000
#define GL_S                                         0x2000
#define GL_T                                         0x2001
#define GL_R                                         0x2002
#define GL_Q                                         0x2003
#define GL_MODULATE                                  0x2100
#define GL_DECAL                                     0x2101
#define GL_TEXTURE_ENV_MODE                          0x2200
#define GL_TEXTURE_ENV_COLOR                         0x2201
#define GL_TEXTURE_ENV                               0x2300
#define GL_EYE_LINEAR                                0x2400
#define GL_OBJECT_LINEAR                             0x2401
#define GL_SPHERE_MAP                                0x2402
#define GL_TEXTURE_GEN_MODE                          0x2500
#define GL_OBJECT_PLANE                              0x2501
#define GL_EYE_PLANE                                 0x2502
#define GL_NEAREST                                   0x2600
#define GL_LINEAR                                    0x2601
#define GL_NEAREST_MIPMAP_NEAREST                    0x2700
#define GL_LINEAR_MIPMAP_NEAREST                     0x2701
#define GL_NEAREST_MIPMAP_LINEAR                     0x2702
#define GL_LINEAR_MIPMAP_LINEAR                      0x2703
#define GL_TEXTURE_MAG_FILTER                        0x2800
#define GL_TEXTURE_MIN_FILTER                        0x2801
#define GL_TEXTURE_WRAP_S                            0x2802
#define GL_TEXTURE_WRAP_T                            0x2803
#define GL_CLAMP                                     0x2900
#define GL_REPEAT                                    0x2901
#define GL_POLYGON_OFFSET_UNITS                      0x2A00
#define GL_POLYGON_OFFSET_POINT                      0x2A01
#define GL_POLYGON_OFFSET_LINE                       0x2A02
#define GL_R3_G3_B2                                  0x2A10
#define GL_V2F                                       0x2A20
#define GL_V3F                                       0x2A21
#define GL_C4UB_V2F                                  0x2A22
#define GL_C4UB_V3F                                  0x2A23
#define GL_C3F_V3F                                   0x2A24
#define GL_N3F_V3F                                   0x2A25
#define GL_C4F_N3F_V3F                               0x2A26
#define GL_T2F_V3F                                   0x2A27
#define GL_T4F_V4F                                   0x2A28
#define GL_T2F_C4UB_V3F                              0x2A29
#define GL_T2F_C3F_V3F                               0x2A2A
#define GL_T2F_N3F_V3F                               0x2A2B
#define GL_T2F_C4F_N3F_V3F                           0x2A2C
#define GL_T4F_C4F_N3F_V4F                           0x2A2D
#define GL_CLIP_PLANE0                               0x3000
#define GL_CLIP_PLANE1                               0x3001
#define GL_CLIP_PLANE2                               0x3002
#define GL_CLIP_PLANE3                               0x3003
#define GL_CLIP_PLANE4                               0x3004
#define GL_CLIP_PLANE5                               0x3005
#define GL_COLOR_BUFFER_BIT                          0x4000
#define GL_LIGHT0                                    0x4000
#define GL_LIGHT1                                    0x4001
#define GL_LIGHT2                                    0x4002
#define GL_LIGHT3                                    0x4003
#define GL_LIGHT4                                    0x4004
#define GL_LIGHT5                                    0x4005
#define GL_LIGHT6                                    0x4006
#define GL_LIGHT7                                    0x4007
#define GL_ABGR_EXT                                  0x8000
#define GL_HINT_BIT                                  0x8000
#define GL_CONSTANT_COLOR                            0x8001
#define GL_CONSTANT_COLOR_EXT                        0x8001
#define GL_ONE_MINUS_CONSTANT_COLOR                  0x8002
#define GL_ONE_MINUS_CONSTANT_COLOR_EXT              0x8002
#define GL_CONSTANT_ALPHA                            0x8003
#define GL_CONSTANT_ALPHA_EXT                        0x8003
#define GL_ONE_MINUS_CONSTANT_ALPHA                  0x8004
#define GL_ONE_MINUS_CONSTANT_ALPHA_EXT              0x8004
#define GL_BLEND_COLOR                               0x8005
#define GL_BLEND_COLOR_EXT                           0x8005
#define GL_FUNC_ADD                                  0x8006
#define GL_FUNC_ADD_EXT                              0x8006
#define GL_MIN                                       0x8007
#define GL_MIN_EXT                                   0x8007
#define GL_MAX                                       0x8008
#define GL_MAX_EXT                                   0x8008
#define GL_BLEND_EQUATION                            0x8009
#define GL_BLEND_EQUATION_EXT                        0x8009
#define GL_BLEND_EQUATION_RGB_EXT                    0x8009
#define GL_FUNC_SUBTRACT                             0x800A
#define GL_FUNC_SUBTRACT_EXT                         0x800A
#define GL_FUNC_REVERSE_SUBTRACT                     0x800B
#define GL_FUNC_REVERSE_SUBTRACT_EXT                 0x800B
#define GL_CONVOLUTION_1D                            0x8010
#define GL_CONVOLUTION_2D                            0x8011
#define GL_SEPARABLE_2D                              0x8012
#define GL_CONVOLUTION_BORDER_MODE                   0x8013
#define GL_CONVOLUTION_FILTER_SCALE                  0x8014
#define GL_CONVOLUTION_FILTER_BIAS                   0x8015
#define GL_REDUCE                                    0x8016
#define GL_CONVOLUTION_FORMAT                        0x8017
#define GL_CONVOLUTION_WIDTH                         0x8018
#define GL_CONVOLUTION_HEIGHT                        0x8019
#define GL_MAX_CONVOLUTION_WIDTH                     0x801A
#define GL_MAX_CONVOLUTION_HEIGHT                    0x801B
#define GL_POST_CONVOLUTION_RED_SCALE                0x801C
#define GL_POST_CONVOLUTION_GREEN_SCALE              0x801D
#define GL_POST_CONVOLUTION_BLUE_SCALE               0x801E
#define GL_POST_CONVOLUTION_ALPHA_SCALE              0x801F
#define GL_POST_CONVOLUTION_RED_BIAS                 0x8020
#define GL_POST_CONVOLUTION_GREEN_BIAS               0x8021
#define GL_POST_CONVOLUTION_BLUE_BIAS                0x8022
#define GL_POST_CONVOLUTION_ALPHA_BIAS               0x8023
#define GL_HISTOGRAM                                 0x8024
#define GL_PROXY_HISTOGRAM                           0x8025
#define GL_HISTOGRAM_WIDTH                           0x8026
#define GL_HISTOGRAM_FORMAT                          0x8027
#define GL_HISTOGRAM_RED_SIZE                        0x8028
#define GL_HISTOGRAM_GREEN_SIZE                      0x8029
#define GL_HISTOGRAM_BLUE_SIZE                       0x802A
#define GL_HISTOGRAM_ALPHA_SIZE                      0x802B
#define GL_HISTOGRAM_LUMINANCE_SIZE                  0x802C
#define GL_HISTOGRAM_SINK                            0x802D
#define GL_MINMAX                                    0x802E
#define GL_MINMAX_FORMAT                             0x802F
#define GL_MINMAX_SINK                               0x8030
#define GL_TABLE_TOO_LARGE                           0x8031
#define GL_UNSIGNED_BYTE_3_3_2                       0x8032
#define GL_UNSIGNED_SHORT_4_4_4_4                    0x8033
#define GL_UNSIGNED_SHORT_5_5_5_1                    0x8034
#define GL_UNSIGNED_INT_8_8_8_8                      0x8035
#define GL_UNSIGNED_INT_10_10_10_2                   0x8036
#define GL_POLYGON_OFFSET_EXT                        0x8037
#define GL_POLYGON_OFFSET_FILL                       0x8037
#define GL_POLYGON_OFFSET_FACTOR                     0x8038
#define GL_POLYGON_OFFSET_FACTOR_EXT                 0x8038
#define GL_POLYGON_OFFSET_BIAS_EXT                   0x8039
#define GL_RESCALE_NORMAL                            0x803A
#define GL_RESCALE_NORMAL_EXT                        0x803A
#define GL_ALPHA4                                    0x803B
#define GL_ALPHA4_EXT                                0x803B
#define GL_ALPHA8                                    0x803C
#define GL_ALPHA8_EXT                                0x803C
#define GL_ALPHA12                                   0x803D
#define GL_ALPHA12_EXT                               0x803D
#define GL_ALPHA16                                   0x803E
#define GL_ALPHA16_EXT                               0x803E
#define GL_LUMINANCE4                                0x803F
#define GL_LUMINANCE4_EXT                            0x803F
#define GL_LUMINANCE8                                0x8040
#define GL_LUMINANCE8_EXT                            0x8040
#define GL_LUMINANCE12                               0x8041
#define GL_LUMINANCE12_EXT                           0x8041
#define GL_LUMINANCE16                               0x8042
#define GL_LUMINANCE16_EXT                           0x8042
#define GL_LUMINANCE4_ALPHA4                         0x8043
#define GL_LUMINANCE4_ALPHA4_EXT                     0x8043
#define GL_LUMINANCE6_ALPHA2                         0x8044
#define GL_LUMINANCE6_ALPHA2_EXT                     0x8044
#define GL_LUMINANCE8_ALPHA8                         0x8045
#define GL_LUMINANCE8_ALPHA8_EXT                     0x8045
#define GL_LUMINANCE12_ALPHA4                        0x8046
#define GL_LUMINANCE12_ALPHA4_EXT                    0x8046
#define GL_LUMINANCE12_ALPHA12                       0x8047
#define GL_LUMINANCE12_ALPHA12_EXT                   0x8047
#define GL_LUMINANCE16_ALPHA16                       0x8048
#define GL_LUMINANCE16_ALPHA16_EXT                   0x8048
#define GL_INTENSITY                                 0x8049
#define GL_INTENSITY_EXT                             0x8049
#define GL_INTENSITY4                                0x804A
#define GL_INTENSITY4_EXT                            0x804A
#define GL_INTENSITY8                                0x804B
#define GL_INTENSITY8_EXT                            0x804B
#define GL_INTENSITY12                               0x804C
#define GL_INTENSITY12_EXT                           0x804C
#define GL_INTENSITY16                               0x804D
#define GL_INTENSITY16_EXT                           0x804D
#define GL_RGB2_EXT                                  0x804E
#define GL_RGB4                                      0x804F
#define GL_RGB4_EXT                                  0x804F
#define GL_RGB5                                      0x8050
#define GL_RGB5_EXT                                  0x8050
#define GL_RGB8                                      0x8051
#define GL_RGB8_EXT                                  0x8051
#define GL_RGB10                                     0x8052
#define GL_RGB10_EXT                                 0x8052
#define GL_RGB12                                     0x8053
#define GL_RGB12_EXT                                 0x8053
#define GL_RGB16                                     0x8054
#define GL_RGB16_EXT                                 0x8054
#define GL_RGBA2                                     0x8055
#define GL_RGBA2_EXT                                 0x8055
#define GL_RGBA4                                     0x8056
#define GL_RGBA4_EXT                                 0x8056
#define GL_RGB5_A1                                   0x8057
#define GL_RGB5_A1_EXT                               0x8057
#define GL_RGBA8                                     0x8058
#define GL_RGBA8_EXT                                 0x8058
#define GL_RGB10_A2                                  0x8059
#define GL_RGB10_A2_EXT                              0x8059
#define GL_RGBA12                                    0x805A
#define GL_RGBA12_EXT                                0x805A
#define GL_RGBA16                                    0x805B
#define GL_RGBA16_EXT                                0x805B
#define GL_TEXTURE_RED_SIZE                          0x805C
#define GL_TEXTURE_RED_SIZE_EXT                      0x805C
#define GL_TEXTURE_GREEN_SIZE                        0x805D
#define GL_TEXTURE_GREEN_SIZE_EXT                    0x805D
#define GL_TEXTURE_BLUE_SIZE                         0x805E
#define GL_TEXTURE_BLUE_SIZE_EXT                     0x805E
#define GL_TEXTURE_ALPHA_SIZE                        0x805F
#define GL_TEXTURE_ALPHA_SIZE_EXT                    0x805F
#define GL_TEXTURE_LUMINANCE_SIZE                    0x8060
#define GL_TEXTURE_LUMINANCE_SIZE_EXT                0x8060
#define GL_TEXTURE_INTENSITY_SIZE                    0x8061
#define GL_TEXTURE_INTENSITY_SIZE_EXT                0x8061
#define GL_REPLACE_EXT                               0x8062
#define GL_PROXY_TEXTURE_1D                          0x8063
#define GL_PROXY_TEXTURE_1D_EXT                      0x8063
#define GL_PROXY_TEXTURE_2D                          0x8064
#define GL_PROXY_TEXTURE_2D_EXT                      0x8064
#define GL_TEXTURE_TOO_LARGE_EXT                     0x8065
#define GL_TEXTURE_PRIORITY                          0x8066
#define GL_TEXTURE_PRIORITY_EXT                      0x8066
#define GL_TEXTURE_RESIDENT                          0x8067
#define GL_TEXTURE_RESIDENT_EXT                      0x8067
#define GL_TEXTURE_1D_BINDING_EXT                    0x8068
#define GL_TEXTURE_BINDING_1D                        0x8068
#define GL_TEXTURE_2D_BINDING_EXT                    0x8069
#define GL_TEXTURE_BINDING_2D                        0x8069
#define GL_TEXTURE_3D_BINDING_EXT                    0x806A
#define GL_TEXTURE_BINDING_3D                        0x806A
#define GL_PACK_SKIP_IMAGES                          0x806B
#define GL_PACK_SKIP_IMAGES_EXT                      0x806B
#define GL_PACK_IMAGE_HEIGHT                         0x806C
#define GL_PACK_IMAGE_HEIGHT_EXT                     0x806C
#define GL_UNPACK_SKIP_IMAGES                        0x806D
#define GL_UNPACK_SKIP_IMAGES_EXT                    0x806D
#define GL_UNPACK_IMAGE_HEIGHT                       0x806E
#define GL_UNPACK_IMAGE_HEIGHT_EXT                   0x806E
#define GL_TEXTURE_3D                                0x806F
#define GL_TEXTURE_3D_EXT                            0x806F
#define GL_PROXY_TEXTURE_3D                          0x8070
#define GL_PROXY_TEXTURE_3D_EXT                      0x8070
#define GL_TEXTURE_DEPTH                             0x8071
#define GL_TEXTURE_DEPTH_EXT                         0x8071
#define GL_TEXTURE_WRAP_R                            0x8072
#define GL_TEXTURE_WRAP_R_EXT                        0x8072
#define GL_MAX_3D_TEXTURE_SIZE                       0x8073
#define GL_MAX_3D_TEXTURE_SIZE_EXT                   0x8073
#define GL_VERTEX_ARRAY                              0x8074
#define GL_VERTEX_ARRAY_EXT                          0x8074
#define GL_NORMAL_ARRAY                              0x8075
#define GL_NORMAL_ARRAY_EXT                          0x8075
#define GL_COLOR_ARRAY                               0x8076
#define GL_COLOR_ARRAY_EXT                           0x8076
#define GL_INDEX_ARRAY                               0x8077
#define GL_INDEX_ARRAY_EXT                           0x8077
#define GL_TEXTURE_COORD_ARRAY                       0x8078
#define GL_TEXTURE_COORD_ARRAY_EXT                   0x8078
#define GL_EDGE_FLAG_ARRAY                           0x8079
#define GL_EDGE_FLAG_ARRAY_EXT                       0x8079
#define GL_VERTEX_ARRAY_SIZE                         0x807A
#define GL_VERTEX_ARRAY_SIZE_EXT                     0x807A
#define GL_VERTEX_ARRAY_TYPE                         0x807B
#define GL_VERTEX_ARRAY_TYPE_EXT                     0x807B
#define GL_VERTEX_ARRAY_STRIDE                       0x807C
#define GL_VERTEX_ARRAY_STRIDE_EXT                   0x807C
#define GL_VERTEX_ARRAY_COUNT_EXT                    0x807D
#define GL_NORMAL_ARRAY_TYPE                         0x807E
#define GL_NORMAL_ARRAY_TYPE_EXT                     0x807E
#define GL_NORMAL_ARRAY_STRIDE                       0x807F
#define GL_NORMAL_ARRAY_STRIDE_EXT                   0x807F
#define GL_NORMAL_ARRAY_COUNT_EXT                    0x8080
#define GL_COLOR_ARRAY_SIZE                          0x8081
#define GL_COLOR_ARRAY_SIZE_EXT                      0x8081
#define GL_COLOR_ARRAY_TYPE                          0x8082
#define GL_COLOR_ARRAY_TYPE_EXT                      0x8082
#define GL_COLOR_ARRAY_STRIDE                        0x8083
#define GL_COLOR_ARRAY_STRIDE_EXT                    0x8083
#define GL_COLOR_ARRAY_COUNT_EXT                     0x8084
#define GL_INDEX_ARRAY_TYPE                          0x8085
#define GL_INDEX_ARRAY_TYPE_EXT                      0x8085
#define GL_INDEX_ARRAY_STRIDE                        0x8086
#define GL_INDEX_ARRAY_STRIDE_EXT                    0x8086
#define GL_INDEX_ARRAY_COUNT_EXT                     0x8087
#define GL_TEXTURE_COORD_ARRAY_SIZE                  0x8088
#define GL_TEXTURE_COORD_ARRAY_SIZE_EXT              0x8088
#define GL_TEXTURE_COORD_ARRAY_TYPE                  0x8089
#define GL_TEXTURE_COORD_ARRAY_TYPE_EXT              0x8089
#define GL_TEXTURE_COORD_ARRAY_STRIDE                0x808A
#define GL_TEXTURE_COORD_ARRAY_STRIDE_EXT            0x808A
#define GL_TEXTURE_COORD_ARRAY_COUNT_EXT             0x808B
#define GL_EDGE_FLAG_ARRAY_STRIDE                    0x808C
#define GL_EDGE_FLAG_ARRAY_STRIDE_EXT                0x808C
#define GL_EDGE_FLAG_ARRAY_COUNT_EXT                 0x808D
#define GL_VERTEX_ARRAY_POINTER                      0x808E
#define GL_VERTEX_ARRAY_POINTER_EXT                  0x808E
#define GL_NORMAL_ARRAY_POINTER                      0x808F
#define GL_NORMAL_ARRAY_POINTER_EXT                  0x808F
#define GL_COLOR_ARRAY_POINTER                       0x8090
#define GL_COLOR_ARRAY_POINTER_EXT                   0x8090
#define GL_INDEX_ARRAY_POINTER                       0x8091
#define GL_INDEX_ARRAY_POINTER_EXT                   0x8091
#define GL_TEXTURE_COORD_ARRAY_POINTER               0x8092
#define GL_TEXTURE_COORD_ARRAY_POINTER_EXT           0x8092
#define GL_EDGE_FLAG_ARRAY_POINTER                   0x8093
#define GL_EDGE_FLAG_ARRAY_POINTER_EXT               0x8093
#define GL_MULTISAMPLE                               0x809D
#define GL_MULTISAMPLE_ARB                           0x809D
#define GL_SAMPLE_ALPHA_TO_COVERAGE                  0x809E
#define GL_SAMPLE_ALPHA_TO_COVERAGE_ARB              0x809E
#define GL_SAMPLE_ALPHA_TO_ONE                       0x809F
#define GL_SAMPLE_ALPHA_TO_ONE_ARB                   0x809F
#define GL_SAMPLE_COVERAGE                           0x80A0
#define GL_SAMPLE_COVERAGE_ARB                       0x80A0
#define GL_SAMPLE_BUFFERS                            0x80A8
#define GL_SAMPLE_BUFFERS_ARB                        0x80A8
#define GL_SAMPLES                                   0x80A9
#define GL_SAMPLES_ARB                               0x80A9
#define GL_SAMPLE_COVERAGE_VALUE                     0x80AA
#define GL_SAMPLE_COVERAGE_VALUE_ARB                 0x80AA
#define GL_SAMPLE_COVERAGE_INVERT                    0x80AB
#define GL_SAMPLE_COVERAGE_INVERT_ARB                0x80AB
#define GL_COLOR_MATRIX                              0x80B1
#define GL_COLOR_MATRIX_STACK_DEPTH                  0x80B2
#define GL_MAX_COLOR_MATRIX_STACK_DEPTH              0x80B3
#define GL_POST_COLOR_MATRIX_RED_SCALE               0x80B4
#define GL_POST_COLOR_MATRIX_GREEN_SCALE             0x80B5
#define GL_POST_COLOR_MATRIX_BLUE_SCALE              0x80B6
#define GL_POST_COLOR_MATRIX_ALPHA_SCALE             0x80B7
#define GL_POST_COLOR_MATRIX_RED_BIAS                0x80B8
#define GL_POST_COLOR_MATRIX_GREEN_BIAS              0x80B9
#define GL_POST_COLOR_MATRIX_BLUE_BIAS               0x80BA
#define GL_POST_COLOR_MATRIX_ALPHA_BIAS              0x80BB
#define GL_BLEND_DST_RGB                             0x80C8
#define GL_BLEND_DST_RGB_EXT                         0x80C8
#define GL_BLEND_SRC_RGB                             0x80C9
#define GL_BLEND_SRC_RGB_EXT                         0x80C9
#define GL_BLEND_DST_ALPHA                           0x80CA
#define GL_BLEND_DST_ALPHA_EXT                       0x80CA
#define GL_BLEND_SRC_ALPHA                           0x80CB
#define GL_BLEND_SRC_ALPHA_EXT                       0x80CB
#define GL_COLOR_TABLE                               0x80D0
#define GL_POST_CONVOLUTION_COLOR_TABLE              0x80D1
#define GL_POST_COLOR_MATRIX_COLOR_TABLE             0x80D2
#define GL_PROXY_COLOR_TABLE                         0x80D3
#define GL_PROXY_POST_CONVOLUTION_COLOR_TABLE        0x80D4
#define GL_PROXY_POST_COLOR_MATRIX_COLOR_TABLE       0x80D5
#define GL_COLOR_TABLE_SCALE                         0x80D6
#define GL_COLOR_TABLE_BIAS                          0x80D7
#define GL_COLOR_TABLE_FORMAT                        0x80D8
#define GL_COLOR_TABLE_WIDTH                         0x80D9
#define GL_COLOR_TABLE_RED_SIZE                      0x80DA
#define GL_COLOR_TABLE_GREEN_SIZE                    0x80DB
#define GL_COLOR_TABLE_BLUE_SIZE                     0x80DC
#define GL_COLOR_TABLE_ALPHA_SIZE                    0x80DD
#define GL_COLOR_TABLE_LUMINANCE_SIZE                0x80DE
#define GL_COLOR_TABLE_INTENSITY_SIZE                0x80DF
#define GL_BGR                                       0x80E0
#define GL_BGR_EXT                                   0x80E0
#define GL_BGRA                                      0x80E1
#define GL_BGRA_EXT                                  0x80E1
#define GL_MAX_ELEMENTS_VERTICES                     0x80E8
#define GL_MAX_ELEMENTS_VERTICES_EXT                 0x80E8
#define GL_MAX_ELEMENTS_INDICES                      0x80E9
#define GL_MAX_ELEMENTS_INDICES_EXT                  0x80E9
#define GL_POINT_SIZE_MIN                            0x8126
#define GL_POINT_SIZE_MIN_ARB                        0x8126
#define GL_POINT_SIZE_MIN_EXT                        0x8126
#define GL_POINT_SIZE_MAX                            0x8127
#define GL_POINT_SIZE_MAX_ARB                        0x8127
#define GL_POINT_SIZE_MAX_EXT                        0x8127
#define GL_POINT_FADE_THRESHOLD_SIZE                 0x8128
#define GL_POINT_FADE_THRESHOLD_SIZE_ARB             0x8128
#define GL_POINT_FADE_THRESHOLD_SIZE_EXT             0x8128
#define GL_DISTANCE_ATTENUATION_EXT                  0x8129
#define GL_POINT_DISTANCE_ATTENUATION                0x8129
#define GL_POINT_DISTANCE_ATTENUATION_ARB            0x8129
#define GL_CLAMP_TO_BORDER                           0x812D
#define GL_CLAMP_TO_BORDER_ARB                       0x812D
#define GL_CLAMP_TO_EDGE                             0x812F
#define GL_TEXTURE_MIN_LOD                           0x813A
#define GL_TEXTURE_MAX_LOD                           0x813B
#define GL_TEXTURE_BASE_LEVEL                        0x813C
#define GL_TEXTURE_MAX_LEVEL                         0x813D
#define GL_CONSTANT_BORDER                           0x8151
#define GL_REPLICATE_BORDER                          0x8153
#define GL_CONVOLUTION_BORDER_COLOR                  0x8154
#define GL_GENERATE_MIPMAP                           0x8191
#define GL_GENERATE_MIPMAP_HINT                      0x8192
#define GL_DEPTH_COMPONENT16                         0x81A5
#define GL_DEPTH_COMPONENT16_ARB                     0x81A5
#define GL_DEPTH_COMPONENT24                         0x81A6
#define GL_DEPTH_COMPONENT24_ARB                     0x81A6
#define GL_DEPTH_COMPONENT32                         0x81A7
#define GL_DEPTH_COMPONENT32_ARB                     0x81A7
#define GL_ARRAY_ELEMENT_LOCK_FIRST_EXT              0x81A8
#define GL_ARRAY_ELEMENT_LOCK_COUNT_EXT              0x81A9
#define GL_LIGHT_MODEL_COLOR_CONTROL                 0x81F8
#define GL_LIGHT_MODEL_COLOR_CONTROL_EXT             0x81F8
#define GL_SINGLE_COLOR                              0x81F9
#define GL_SINGLE_COLOR_EXT                          0x81F9
#define GL_SEPARATE_SPECULAR_COLOR                   0x81FA
#define GL_SEPARATE_SPECULAR_COLOR_EXT               0x81FA
#define GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING     0x8210
#define GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE     0x8211
#define GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE           0x8212
#define GL_FRAMEBUFFER_ATTACHMENT_GREEN_SIZE         0x8213
#define GL_FRAMEBUFFER_ATTACHMENT_BLUE_SIZE          0x8214
#define GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE         0x8215
#define GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE         0x8216
#define GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE       0x8217
#define GL_FRAMEBUFFER_DEFAULT                       0x8218
#define GL_FRAMEBUFFER_UNDEFINED                     0x8219
#define GL_DEPTH_STENCIL_ATTACHMENT                  0x821A
#define GL_MAJOR_VERSION                             0x821B
#define GL_MINOR_VERSION                             0x821C
#define GL_NUM_EXTENSIONS                            0x821D
#define GL_RG                                        0x8227
#define GL_CONTEXT_FLAGS                             0x821E
#define GL_INDEX                                     0x8222
#define GL_UNSIGNED_BYTE_2_3_3_REV                   0x8362
#define GL_UNSIGNED_SHORT_5_6_5                      0x8363
#define GL_UNSIGNED_SHORT_5_6_5_REV                  0x8364
#define GL_UNSIGNED_SHORT_4_4_4_4_REV                0x8365
#define GL_UNSIGNED_SHORT_1_5_5_5_REV                0x8366
#define GL_UNSIGNED_INT_8_8_8_8_REV                  0x8367
#define GL_UNSIGNED_INT_2_10_10_10_REV               0x8368
#define GL_MIRRORED_REPEAT                           0x8370
#define GL_MIRRORED_REPEAT_ARB                       0x8370
#define GL_COMPRESSED_RGB_S3TC_DXT1_EXT              0x83F0
#define GL_COMPRESSED_RGBA_S3TC_DXT1_EXT             0x83F1
#define GL_COMPRESSED_RGBA_S3TC_DXT3_EXT             0x83F2
#define GL_COMPRESSED_RGBA_S3TC_DXT5_EXT             0x83F3
#define GL_FOG_COORDINATE_SOURCE                     0x8450
#define GL_FOG_COORDINATE_SOURCE_EXT                 0x8450
#define GL_FOG_COORD_SRC                             0x8450
#define GL_FOG_COORD                                 0x8451
#define GL_FOG_COORDINATE                            0x8451
#define GL_FOG_COORDINATE_EXT                        0x8451
#define GL_FRAGMENT_DEPTH                            0x8452
#define GL_FRAGMENT_DEPTH_EXT                        0x8452
#define GL_CURRENT_FOG_COORD                         0x8453
#define GL_CURRENT_FOG_COORDINATE                    0x8453
#define GL_CURRENT_FOG_COORDINATE_EXT                0x8453
#define GL_FOG_COORDINATE_ARRAY_TYPE                 0x8454
#define GL_FOG_COORDINATE_ARRAY_TYPE_EXT             0x8454
#define GL_FOG_COORD_ARRAY_TYPE                      0x8454
#define GL_FOG_COORDINATE_ARRAY_STRIDE               0x8455
#define GL_FOG_COORDINATE_ARRAY_STRIDE_EXT           0x8455
#define GL_FOG_COORD_ARRAY_STRIDE                    0x8455
#define GL_FOG_COORDINATE_ARRAY_POINTER              0x8456
#define GL_FOG_COORDINATE_ARRAY_POINTER_EXT          0x8456
#define GL_FOG_COORD_ARRAY_POINTER                   0x8456
#define GL_FOG_COORDINATE_ARRAY                      0x8457
#define GL_FOG_COORDINATE_ARRAY_EXT                  0x8457
#define GL_FOG_COORD_ARRAY                           0x8457
#define GL_COLOR_SUM                                 0x8458
#define GL_COLOR_SUM_EXT                             0x8458
#define GL_CURRENT_SECONDARY_COLOR                   0x8459
#define GL_CURRENT_SECONDARY_COLOR_EXT               0x8459
#define GL_SECONDARY_COLOR_ARRAY_SIZE                0x845A
#define GL_SECONDARY_COLOR_ARRAY_SIZE_EXT            0x845A
#define GL_SECONDARY_COLOR_ARRAY_TYPE                0x845B
#define GL_SECONDARY_COLOR_ARRAY_TYPE_EXT            0x845B
#define GL_SECONDARY_COLOR_ARRAY_STRIDE              0x845C
#define GL_SECONDARY_COLOR_ARRAY_STRIDE_EXT          0x845C
#define GL_SECONDARY_COLOR_ARRAY_POINTER             0x845D
#define GL_SECONDARY_COLOR_ARRAY_POINTER_EXT         0x845D
#define GL_SECONDARY_COLOR_ARRAY                     0x845E
#define GL_SECONDARY_COLOR_ARRAY_EXT                 0x845E
#define GL_CURRENT_RASTER_SECONDARY_COLOR            0x845F
#define GL_ALIASED_POINT_SIZE_RANGE                  0x846D
#define GL_ALIASED_LINE_WIDTH_RANGE                  0x846E
#define GL_TEXTURE0                                  0x84C0
#define GL_TEXTURE0_ARB                              0x84C0
#define GL_TEXTURE1                                  0x84C1
#define GL_TEXTURE1_ARB                              0x84C1
#define GL_TEXTURE2                                  0x84C2
#define GL_TEXTURE2_ARB                              0x84C2
#define GL_TEXTURE3                                  0x84C3
#define GL_TEXTURE3_ARB                              0x84C3
#define GL_TEXTURE4                                  0x84C4
#define GL_TEXTURE4_ARB                              0x84C4
#define GL_TEXTURE5                                  0x84C5
#define GL_TEXTURE5_ARB                              0x84C5
#define GL_TEXTURE6                                  0x84C6
#define GL_TEXTURE6_ARB                              0x84C6
#define GL_TEXTURE7                                  0x84C7
#define GL_TEXTURE7_ARB                              0x84C7
#define GL_TEXTURE8                                  0x84C8
#define GL_TEXTURE8_ARB                              0x84C8
#define GL_TEXTURE9                                  0x84C9
#define GL_TEXTURE9_ARB                              0x84C9
#define GL_TEXTURE10                                 0x84CA
#define GL_TEXTURE10_ARB                             0x84CA
#define GL_TEXTURE11                                 0x84CB
#define GL_TEXTURE11_ARB                             0x84CB
#define GL_TEXTURE12                                 0x84CC
#define GL_TEXTURE12_ARB                             0x84CC
#define GL_TEXTURE13                                 0x84CD
#define GL_TEXTURE13_ARB                             0x84CD
#define GL_TEXTURE14                                 0x84CE
#define GL_TEXTURE14_ARB                             0x84CE
#define GL_TEXTURE15                                 0x84CF
#define GL_TEXTURE15_ARB                             0x84CF
#define GL_TEXTURE16                                 0x84D0
#define GL_TEXTURE16_ARB                             0x84D0
#define GL_TEXTURE17                                 0x84D1
#define GL_TEXTURE17_ARB                             0x84D1
#define GL_TEXTURE18                                 0x84D2
#define GL_TEXTURE18_ARB                             0x84D2
#define GL_TEXTURE19                                 0x84D3
#define GL_TEXTURE19_ARB                             0x84D3
#define GL_TEXTURE20                                 0x84D4
#define GL_TEXTURE20_ARB                             0x84D4
#define GL_TEXTURE21                                 0x84D5
#define GL_TEXTURE21_ARB                             0x84D5
#define GL_TEXTURE22                                 0x84D6
#define GL_TEXTURE22_ARB                             0x84D6
#define GL_TEXTURE23                                 0x84D7
#define GL_TEXTURE23_ARB                             0x84D7
#define GL_TEXTURE24                                 0x84D8
#define GL_TEXTURE24_ARB                             0x84D8
#define GL_TEXTURE25                                 0x84D9
#define GL_TEXTURE25_ARB                             0x84D9
#define GL_TEXTURE26                                 0x84DA
#define GL_TEXTURE26_ARB                             0x84DA
#define GL_TEXTURE27                                 0x84DB
#define GL_TEXTURE27_ARB                             0x84DB
#define GL_TEXTURE28                                 0x84DC
#define GL_TEXTURE28_ARB                             0x84DC
#define GL_TEXTURE29                                 0x84DD
#define GL_TEXTURE29_ARB                             0x84DD
#define GL_TEXTURE30                                 0x84DE
#define GL_TEXTURE30_ARB                             0x84DE
#define GL_TEXTURE31                                 0x84DF
#define GL_TEXTURE31_ARB                             0x84DF
#define GL_ACTIVE_TEXTURE                            0x84E0
#define GL_ACTIVE_TEXTURE_ARB                        0x84E0
#define GL_CLIENT_ACTIVE_TEXTURE                     0x84E1
#define GL_CLIENT_ACTIVE_TEXTURE_ARB                 0x84E1
#define GL_MAX_TEXTURE_UNITS                         0x84E2
#define GL_MAX_TEXTURE_UNITS_ARB                     0x84E2
#define GL_TRANSPOSE_MODELVIEW_MATRIX                0x84E3
#define GL_TRANSPOSE_MODELVIEW_MATRIX_ARB            0x84E3
#define GL_TRANSPOSE_PROJECTION_MATRIX               0x84E4
#define GL_TRANSPOSE_PROJECTION_MATRIX_ARB           0x84E4
#define GL_TRANSPOSE_TEXTURE_MATRIX                  0x84E5
#define GL_TRANSPOSE_TEXTURE_MATRIX_ARB              0x84E5
#define GL_TRANSPOSE_COLOR_MATRIX                    0x84E6
#define GL_TRANSPOSE_COLOR_MATRIX_ARB                0x84E6
#define GL_SUBTRACT                                  0x84E7
#define GL_SUBTRACT_ARB                              0x84E7
#define GL_MAX_RENDERBUFFER_SIZE_EXT                 0x84E8
#define GL_COMPRESSED_ALPHA                          0x84E9
#define GL_COMPRESSED_ALPHA_ARB                      0x84E9
#define GL_COMPRESSED_LUMINANCE                      0x84EA
#define GL_COMPRESSED_LUMINANCE_ARB                  0x84EA
#define GL_COMPRESSED_LUMINANCE_ALPHA                0x84EB
#define GL_COMPRESSED_LUMINANCE_ALPHA_ARB            0x84EB
#define GL_COMPRESSED_INTENSITY                      0x84EC
#define GL_COMPRESSED_INTENSITY_ARB                  0x84EC
#define GL_COMPRESSED_RGB                            0x84ED
#define GL_COMPRESSED_RGB_ARB                        0x84ED
#define GL_COMPRESSED_RGBA                           0x84EE
#define GL_COMPRESSED_RGBA_ARB                       0x84EE
#define GL_TEXTURE_COMPRESSION_HINT                  0x84EF
#define GL_TEXTURE_COMPRESSION_HINT_ARB              0x84EF
#define GL_TEXTURE_RECTANGLE_ARB                     0x84F5
#define GL_TEXTURE_BINDING_RECTANGLE_ARB             0x84F6
#define GL_PROXY_TEXTURE_RECTANGLE_ARB               0x84F7
#define GL_MAX_RECTANGLE_TEXTURE_SIZE_ARB            0x84F8
#define GL_DEPTH_STENCIL                             0x84F9
#define GL_DEPTH_STENCIL_EXT                         0x84F9
#define GL_UNSIGNED_INT_24_8                         0x84FA
#define GL_UNSIGNED_INT_24_8_EXT                     0x84FA
#define GL_MAX_TEXTURE_LOD_BIAS                      0x84FD
#define GL_MAX_TEXTURE_LOD_BIAS_EXT                  0x84FD
#define GL_TEXTURE_MAX_ANISOTROPY_EXT                0x84FE
#define GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT            0x84FF
#define GL_TEXTURE_FILTER_CONTROL                    0x8500
#define GL_TEXTURE_FILTER_CONTROL_EXT                0x8500
#define GL_TEXTURE_LOD_BIAS                          0x8501
#define GL_TEXTURE_LOD_BIAS_EXT                      0x8501
#define GL_INCR_WRAP                                 0x8507
#define GL_INCR_WRAP_EXT                             0x8507
#define GL_DECR_WRAP                                 0x8508
#define GL_DECR_WRAP_EXT                             0x8508
#define GL_NORMAL_MAP                                0x8511
#define GL_NORMAL_MAP_ARB                            0x8511
#define GL_NORMAL_MAP_EXT                            0x8511
#define GL_REFLECTION_MAP                            0x8512
#define GL_REFLECTION_MAP_ARB                        0x8512
#define GL_REFLECTION_MAP_EXT                        0x8512
#define GL_TEXTURE_CUBE_MAP                          0x8513
#define GL_TEXTURE_CUBE_MAP_ARB                      0x8513
#define GL_TEXTURE_CUBE_MAP_EXT                      0x8513
#define GL_TEXTURE_BINDING_CUBE_MAP                  0x8514
#define GL_TEXTURE_BINDING_CUBE_MAP_ARB              0x8514
#define GL_TEXTURE_BINDING_CUBE_MAP_EXT              0x8514
#define GL_TEXTURE_CUBE_MAP_POSITIVE_X               0x8515
#define GL_TEXTURE_CUBE_MAP_POSITIVE_X_ARB           0x8515
#define GL_TEXTURE_CUBE_MAP_POSITIVE_X_EXT           0x8515
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_X               0x8516
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_X_ARB           0x8516
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_X_EXT           0x8516
#define GL_TEXTURE_CUBE_MAP_POSITIVE_Y               0x8517
#define GL_TEXTURE_CUBE_MAP_POSITIVE_Y_ARB           0x8517
#define GL_TEXTURE_CUBE_MAP_POSITIVE_Y_EXT           0x8517
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_Y               0x8518
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_Y_ARB           0x8518
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_Y_EXT           0x8518
#define GL_TEXTURE_CUBE_MAP_POSITIVE_Z               0x8519
#define GL_TEXTURE_CUBE_MAP_POSITIVE_Z_ARB           0x8519
#define GL_TEXTURE_CUBE_MAP_POSITIVE_Z_EXT           0x8519
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_Z               0x851A
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_Z_ARB           0x851A
#define GL_TEXTURE_CUBE_MAP_NEGATIVE_Z_EXT           0x851A
#define GL_PROXY_TEXTURE_CUBE_MAP                    0x851B
#define GL_PROXY_TEXTURE_CUBE_MAP_ARB                0x851B
#define GL_PROXY_TEXTURE_CUBE_MAP_EXT                0x851B
#define GL_MAX_CUBE_MAP_TEXTURE_SIZE                 0x851C
#define GL_MAX_CUBE_MAP_TEXTURE_SIZE_ARB             0x851C
#define GL_MAX_CUBE_MAP_TEXTURE_SIZE_EXT             0x851C
#define GL_COMBINE                                   0x8570
#define GL_COMBINE_ARB                               0x8570
#define GL_COMBINE_EXT                               0x8570
#define GL_COMBINE_RGB                               0x8571
#define GL_COMBINE_RGB_ARB                           0x8571
#define GL_COMBINE_RGB_EXT                           0x8571
#define GL_COMBINE_ALPHA                             0x8572
#define GL_COMBINE_ALPHA_ARB                         0x8572
#define GL_COMBINE_ALPHA_EXT                         0x8572
#define GL_RGB_SCALE                                 0x8573
#define GL_RGB_SCALE_ARB                             0x8573
#define GL_RGB_SCALE_EXT                             0x8573
#define GL_ADD_SIGNED                                0x8574
#define GL_ADD_SIGNED_ARB                            0x8574
#define GL_ADD_SIGNED_EXT                            0x8574
#define GL_INTERPOLATE                               0x8575
#define GL_INTERPOLATE_ARB                           0x8575
#define GL_INTERPOLATE_EXT                           0x8575
#define GL_CONSTANT                                  0x8576
#define GL_CONSTANT_ARB                              0x8576
#define GL_CONSTANT_EXT                              0x8576
#define GL_PRIMARY_COLOR                             0x8577
#define GL_PRIMARY_COLOR_ARB                         0x8577
#define GL_PRIMARY_COLOR_EXT                         0x8577
#define GL_PREVIOUS                                  0x8578
#define GL_PREVIOUS_ARB                              0x8578
#define GL_PREVIOUS_EXT                              0x8578
#define GL_SOURCE0_RGB                               0x8580
#define GL_SOURCE0_RGB_ARB                           0x8580
#define GL_SOURCE0_RGB_EXT                           0x8580
#define GL_SRC0_RGB                                  0x8580
#define GL_SOURCE1_RGB                               0x8581
#define GL_SOURCE1_RGB_ARB                           0x8581
#define GL_SOURCE1_RGB_EXT                           0x8581
#define GL_SRC1_RGB                                  0x8581
#define GL_SOURCE2_RGB                               0x8582
#define GL_SOURCE2_RGB_ARB                           0x8582
#define GL_SOURCE2_RGB_EXT                           0x8582
#define GL_SRC2_RGB                                  0x8582
#define GL_SOURCE0_ALPHA                             0x8588
#define GL_SOURCE0_ALPHA_ARB                         0x8588
#define GL_SOURCE0_ALPHA_EXT                         0x8588
#define GL_SRC0_ALPHA                                0x8588
#define GL_SOURCE1_ALPHA                             0x8589
#define GL_SOURCE1_ALPHA_ARB                         0x8589
#define GL_SOURCE1_ALPHA_EXT                         0x8589
#define GL_SRC1_ALPHA                                0x8589
#define GL_SOURCE2_ALPHA                             0x858A
#define GL_SOURCE2_ALPHA_ARB                         0x858A
#define GL_SOURCE2_ALPHA_EXT                         0x858A
#define GL_SRC2_ALPHA                                0x858A
#define GL_OPERAND0_RGB                              0x8590
#define GL_OPERAND0_RGB_ARB                          0x8590
#define GL_OPERAND0_RGB_EXT                          0x8590
#define GL_OPERAND1_RGB                              0x8591
#define GL_OPERAND1_RGB_ARB                          0x8591
#define GL_OPERAND1_RGB_EXT                          0x8591
#define GL_OPERAND2_RGB                              0x8592
#define GL_OPERAND2_RGB_ARB                          0x8592
#define GL_OPERAND2_RGB_EXT                          0x8592
#define GL_OPERAND0_ALPHA                            0x8598
#define GL_OPERAND0_ALPHA_ARB                        0x8598
#define GL_OPERAND0_ALPHA_EXT                        0x8598
#define GL_OPERAND1_ALPHA                            0x8599
#define GL_OPERAND1_ALPHA_ARB                        0x8599
#define GL_OPERAND1_ALPHA_EXT                        0x8599
#define GL_OPERAND2_ALPHA                            0x859A
#define GL_OPERAND2_ALPHA_ARB                        0x859A
#define GL_OPERAND2_ALPHA_EXT                        0x859A
#define GL_VERTEX_PROGRAM_POINT_SIZE                 0x8642
#define GL_TEXTURE_COMPRESSED_IMAGE_SIZE             0x86A0
#define GL_TEXTURE_COMPRESSED_IMAGE_SIZE_ARB         0x86A0
#define GL_TEXTURE_COMPRESSED                        0x86A1
#define GL_TEXTURE_COMPRESSED_ARB                    0x86A1
#define GL_NUM_COMPRESSED_TEXTURE_FORMATS            0x86A2
#define GL_NUM_COMPRESSED_TEXTURE_FORMATS_ARB        0x86A2
#define GL_COMPRESSED_TEXTURE_FORMATS                0x86A3
#define GL_COMPRESSED_TEXTURE_FORMATS_ARB            0x86A3
#define GL_DOT3_RGB                                  0x86AE
#define GL_DOT3_RGB_ARB                              0x86AE
#define GL_DOT3_RGBA                                 0x86AF
#define GL_DOT3_RGBA_ARB                             0x86AF
#define GL_BUFFER_SIZE                               0x8764
#define GL_BUFFER_SIZE_ARB                           0x8764
#define GL_BUFFER_USAGE                              0x8765
#define GL_BUFFER_USAGE_ARB                          0x8765
#define GL_RGBA32F                                   0x8814
#define GL_RGBA16F                                   0x881A
#define GL_MAX_DRAW_BUFFERS                          0x8824
#define GL_ALPHA_BLEND_EQUATION_ATI                  0x883D
#define GL_BLEND_EQUATION_ALPHA_EXT                  0x883D
#define GL_TEXTURE_DEPTH_SIZE                        0x884A
#define GL_TEXTURE_DEPTH_SIZE_ARB                    0x884A
#define GL_DEPTH_TEXTURE_MODE                        0x884B
#define GL_DEPTH_TEXTURE_MODE_ARB                    0x884B
#define GL_TEXTURE_COMPARE_MODE                      0x884C
#define GL_TEXTURE_COMPARE_MODE_ARB                  0x884C
#define GL_TEXTURE_COMPARE_FUNC                      0x884D
#define GL_TEXTURE_COMPARE_FUNC_ARB                  0x884D
#define GL_COMPARE_R_TO_TEXTURE                      0x884E
#define GL_COMPARE_R_TO_TEXTURE_ARB                  0x884E
#define GL_POINT_SPRITE_ARB                          0x8861
#define GL_COORD_REPLACE_ARB                         0x8862
#define GL_QUERY_COUNTER_BITS                        0x8864
#define GL_QUERY_COUNTER_BITS_ARB                    0x8864
#define GL_CURRENT_QUERY                             0x8865
#define GL_CURRENT_QUERY_ARB                         0x8865
#define GL_QUERY_RESULT                              0x8866
#define GL_QUERY_RESULT_ARB                          0x8866
#define GL_QUERY_RESULT_AVAILABLE                    0x8867
#define GL_QUERY_RESULT_AVAILABLE_ARB                0x8867
#define GL_MAX_VERTEX_ATTRIBS                        0x8869
#define GL_ARRAY_BUFFER                              0x8892
#define GL_ARRAY_BUFFER_ARB                          0x8892
#define GL_ELEMENT_ARRAY_BUFFER                      0x8893
#define GL_ELEMENT_ARRAY_BUFFER_ARB                  0x8893
#define GL_ARRAY_BUFFER_BINDING                      0x8894
#define GL_ARRAY_BUFFER_BINDING_ARB                  0x8894
#define GL_ELEMENT_ARRAY_BUFFER_BINDING              0x8895
#define GL_ELEMENT_ARRAY_BUFFER_BINDING_ARB          0x8895
#define GL_VERTEX_ARRAY_BUFFER_BINDING               0x8896
#define GL_VERTEX_ARRAY_BUFFER_BINDING_ARB           0x8896
#define GL_NORMAL_ARRAY_BUFFER_BINDING               0x8897
#define GL_NORMAL_ARRAY_BUFFER_BINDING_ARB           0x8897
#define GL_COLOR_ARRAY_BUFFER_BINDING                0x8898
#define GL_COLOR_ARRAY_BUFFER_BINDING_ARB            0x8898
#define GL_INDEX_ARRAY_BUFFER_BINDING                0x8899
#define GL_INDEX_ARRAY_BUFFER_BINDING_ARB            0x8899
#define GL_TEXTURE_COORD_ARRAY_BUFFER_BINDING        0x889A
#define GL_TEXTURE_COORD_ARRAY_BUFFER_BINDING_ARB    0x889A
#define GL_EDGE_FLAG_ARRAY_BUFFER_BINDING            0x889B
#define GL_EDGE_FLAG_ARRAY_BUFFER_BINDING_ARB        0x889B
#define GL_SECONDARY_COLOR_ARRAY_BUFFER_BINDING      0x889C
#define GL_SECONDARY_COLOR_ARRAY_BUFFER_BINDING_ARB  0x889C
#define GL_FOG_COORDINATE_ARRAY_BUFFER_BINDING       0x889D
#define GL_FOG_COORDINATE_ARRAY_BUFFER_BINDING_ARB   0x889D
#define GL_FOG_COORD_ARRAY_BUFFER_BINDING            0x889D
#define GL_WEIGHT_ARRAY_BUFFER_BINDING               0x889E
#define GL_WEIGHT_ARRAY_BUFFER_BINDING_ARB           0x889E
#define GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING        0x889F
#define GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING_ARB    0x889F
#define GL_READ_ONLY                                 0x88B8
#define GL_READ_ONLY_ARB                             0x88B8
#define GL_WRITE_ONLY                                0x88B9
#define GL_WRITE_ONLY_ARB                            0x88B9
#define GL_READ_WRITE                                0x88BA
#define GL_READ_WRITE_ARB                            0x88BA
#define GL_BUFFER_ACCESS                             0x88BB
#define GL_BUFFER_ACCESS_ARB                         0x88BB
#define GL_BUFFER_MAPPED                             0x88BC
#define GL_BUFFER_MAPPED_ARB                         0x88BC
#define GL_BUFFER_MAP_POINTER                        0x88BD
#define GL_BUFFER_MAP_POINTER_ARB                    0x88BD
#define GL_STREAM_DRAW                               0x88E0
#define GL_STREAM_DRAW_ARB                           0x88E0
#define GL_STREAM_READ                               0x88E1
#define GL_STREAM_READ_ARB                           0x88E1
#define GL_STREAM_COPY                               0x88E2
#define GL_STREAM_COPY_ARB                           0x88E2
#define GL_STATIC_DRAW                               0x88E4
#define GL_STATIC_DRAW_ARB                           0x88E4
#define GL_STATIC_READ                               0x88E5
#define GL_STATIC_READ_ARB                           0x88E5
#define GL_STATIC_COPY                               0x88E6
#define GL_STATIC_COPY_ARB                           0x88E6
#define GL_DYNAMIC_DRAW                              0x88E8
#define GL_DYNAMIC_DRAW_ARB                          0x88E8
#define GL_DYNAMIC_READ                              0x88E9
#define GL_DYNAMIC_READ_ARB                          0x88E9
#define GL_DYNAMIC_COPY                              0x88EA
#define GL_DYNAMIC_COPY_ARB                          0x88EA
#define GL_DEPTH24_STENCIL8_EXT                      0x88F0
#define GL_DEPTH24_STENCIL8                          0x88F0
#define GL_TEXTURE_STENCIL_SIZE_EXT                  0x88F1
#define GL_SAMPLES_PASSED                            0x8914
#define GL_SAMPLES_PASSED_ARB                        0x8914
#define GL_SHADING_LANGUAGE_VERSION                  0x8B8C
#define GL_UNSIGNED_NORMALIZED                       0x8C17
#define GL_POINT_SPRITE_COORD_ORIGIN                 0x8CA0
#define GL_LOWER_LEFT                                0x8CA1
#define GL_UPPER_LEFT                                0x8CA2
#define GL_FRAMEBUFFER_BINDING_EXT                   0x8CA6
#define GL_DRAW_FRAMEBUFFER_BINDING_EXT              0x8CA6
#define GL_RENDERBUFFER_BINDING_EXT                  0x8CA7
#define GL_READ_FRAMEBUFFER                          0x8CA8
#define GL_READ_FRAMEBUFFER_EXT                      0x8CA8
#define GL_DRAW_FRAMEBUFFER                          0x8CA9
#define GL_DRAW_FRAMEBUFFER_EXT                      0x8CA9
#define GL_READ_FRAMEBUFFER_BINDING                  0x8CAA
#define GL_READ_FRAMEBUFFER_BINDING_EXT              0x8CAA
#define GL_RENDERBUFFER_SAMPLES                      0x8CAB
#define GL_DEPTH_COMPONENT32F                        0x8CAC
#define GL_DEPTH32F_STENCIL8                         0x8CAD
#define GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE_EXT    0x8CD0
#define GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME_EXT    0x8CD1
#define GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL_EXT  0x8CD2
#define GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE_EXT 0x8CD3
#define GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_3D_ZOFFSET_EXT 0x8CD4
#define GL_FRAMEBUFFER_COMPLETE_EXT                  0x8CD5
#define GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT_EXT     0x8CD6
#define GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT_EXT 0x8CD7
#define GL_FRAMEBUFFER_INCOMPLETE_DIMENSIONS_EXT     0x8CD9
#define GL_FRAMEBUFFER_INCOMPLETE_FORMATS_EXT        0x8CDA
#define GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER_EXT    0x8CDB
#define GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER_EXT    0x8CDC
#define GL_FRAMEBUFFER_UNSUPPORTED_EXT               0x8CDD
#define GL_MAX_COLOR_ATTACHMENTS                     0x8CDF
#define GL_MAX_COLOR_ATTACHMENTS_EXT                 0x8CDF
#define GL_COLOR_ATTACHMENT0_EXT                     0x8CE0
#define GL_COLOR_ATTACHMENT1_EXT                     0x8CE1
#define GL_COLOR_ATTACHMENT2_EXT                     0x8CE2
#define GL_COLOR_ATTACHMENT3_EXT                     0x8CE3
#define GL_COLOR_ATTACHMENT4_EXT                     0x8CE4
#define GL_COLOR_ATTACHMENT5_EXT                     0x8CE5
#define GL_COLOR_ATTACHMENT6_EXT                     0x8CE6
#define GL_COLOR_ATTACHMENT7_EXT                     0x8CE7
#define GL_COLOR_ATTACHMENT8_EXT                     0x8CE8
#define GL_COLOR_ATTACHMENT9_EXT                     0x8CE9
#define GL_COLOR_ATTACHMENT10_EXT                    0x8CEA
#define GL_COLOR_ATTACHMENT11_EXT                    0x8CEB
#define GL_COLOR_ATTACHMENT12_EXT                    0x8CEC
#define GL_COLOR_ATTACHMENT13_EXT                    0x8CED
#define GL_COLOR_ATTACHMENT14_EXT                    0x8CEE
#define GL_COLOR_ATTACHMENT15_EXT                    0x8CEF
#define GL_DEPTH_ATTACHMENT_EXT                      0x8D00
#define GL_STENCIL_ATTACHMENT_EXT                    0x8D20
#define GL_FRAMEBUFFER_EXT                           0x8D40
#define GL_RENDERBUFFER_EXT                          0x8D41
#define GL_RENDERBUFFER_WIDTH_EXT                    0x8D42
#define GL_RENDERBUFFER_HEIGHT_EXT                   0x8D43
#define GL_RENDERBUFFER_INTERNAL_FORMAT_EXT          0x8D44
#define GL_STENCIL_INDEX1_EXT                        0x8D46
#define GL_STENCIL_INDEX4_EXT                        0x8D47
#define GL_STENCIL_INDEX8_EXT                        0x8D48
#define GL_STENCIL_INDEX16_EXT                       0x8D49
#define GL_RENDERBUFFER_RED_SIZE_EXT                 0x8D50
#define GL_RENDERBUFFER_GREEN_SIZE_EXT               0x8D51
#define GL_RENDERBUFFER_BLUE_SIZE_EXT                0x8D52
#define GL_RENDERBUFFER_ALPHA_SIZE_EXT               0x8D53
#define GL_RENDERBUFFER_DEPTH_SIZE_EXT               0x8D54
#define GL_RENDERBUFFER_STENCIL_SIZE_EXT             0x8D55
#define GL_MAX_SAMPLES                               0x8D57
#define GL_RED_INTEGER                               0x8D94
#define GL_FLOAT_32_UNSIGNED_INT_24_8_REV            0x8DAD
#define GL_TEXTURE_SWIZZLE_R_EXT                     0x8E42
#define GL_TEXTURE_SWIZZLE_G_EXT                     0x8E43
#define GL_TEXTURE_SWIZZLE_B_EXT                     0x8E44
#define GL_TEXTURE_SWIZZLE_A_EXT                     0x8E45
#define GL_TEXTURE_SWIZZLE_RGBA_EXT                  0x8E46
#define GL_EVAL_BIT                                  0x10000
#define GL_LIST_BIT                                  0x20000
#define GL_TEXTURE_BIT                               0x40000
#define GL_SCISSOR_BIT                               0x80000
#define GL_MULTISAMPLE_BIT                           0x20000000
#define GL_MULTISAMPLE_BIT_ARB                       0x20000000
#define GL_ALL_ATTRIB_BITS                           0xFFFFFFFF
#define GL_ALL_CLIENT_ATTRIB_BITS                    0xFFFFFFFF
#define GL_CLIENT_ALL_ATTRIB_BITS                    0xFFFFFFFF

/* lambent's own, above all registered numbers: shadows and bounced light (README.md). Of glEnable. */
#define GL_BOUNCED_LIGHT_LMB                         0x4C4D42

GLAPI void APIENTRY glAccum(GLenum op, GLfloat value);
GLAPI void APIENTRY glActiveTexture(GLenum texture);
GLAPI void APIENTRY glActiveTextureARB(GLenum texture);
GLAPI void APIENTRY glAlphaFunc(GLenum func, GLclampf ref);
GLAPI GLboolean APIENTRY glAreTexturesResident(GLsizei n, const GLuint *textures, GLboolean *residences);
GLAPI GLboolean APIENTRY glAreTexturesResidentEXT(GLsizei n, const GLuint *textures, GLboolean *residences);
GLAPI void APIENTRY glArrayElement(GLint i);
GLAPI void APIENTRY glArrayElementEXT(GLint i);
GLAPI void APIENTRY glBegin(GLenum mode);
GLAPI void APIENTRY glBeginQuery(GLenum target, GLuint id);
GLAPI void APIENTRY glBeginQueryARB(GLenum target, GLuint id);
GLAPI void APIENTRY glBindBuffer(GLenum target, GLuint buffer);
GLAPI void APIENTRY glBindBufferARB(GLenum target, GLuint buffer);
GLAPI void APIENTRY glBindFramebufferEXT(GLenum target, GLuint framebuffer);
GLAPI void APIENTRY glBindRenderbufferEXT(GLenum target, GLuint renderbuffer);
GLAPI void APIENTRY glBindTexture(GLenum target, GLuint texture);
GLAPI void APIENTRY glBindTextureEXT(GLenum target, GLuint texture);
GLAPI void APIENTRY glBitmap(GLsizei width, GLsizei height, GLfloat xorig, GLfloat yorig, GLfloat xmove,
    GLfloat ymove, const GLubyte *bitmap);
GLAPI void APIENTRY glBlendColor(GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha);
GLAPI void APIENTRY glBlendColorEXT(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha);
GLAPI void APIENTRY glBlendEquation(GLenum mode);
GLAPI void APIENTRY glBlendEquationEXT(GLenum mode);
GLAPI void APIENTRY glBlendEquationSeparateEXT(GLenum rgb, GLenum alpha);
GLAPI void APIENTRY glBlendFunc(GLenum sfactor, GLenum dfactor);
GLAPI void APIENTRY glBlendFuncSeparate(GLenum sfactorRGB, GLenum dfactorRGB, GLenum sfactorAlpha, GLenum dfactorAlpha);
GLAPI void APIENTRY glBlendFuncSeparateEXT(GLenum sfactorRGB, GLenum dfactorRGB, GLenum sfactorAlpha,
    GLenum dfactorAlpha);
GLAPI void APIENTRY glBlitFramebufferEXT(GLint sx0, GLint sy0, GLint sx1, GLint sy1, GLint dx0, GLint dy0, GLint dx1,
    GLint dy1, GLbitfield mask, GLenum filter);
GLAPI void APIENTRY glBufferData(GLenum target, GLsizeiptr size, const void *data, GLenum usage);
GLAPI void APIENTRY glBufferDataARB(GLenum target, GLsizeiptrARB size, const void *data, GLenum usage);
GLAPI void APIENTRY glBufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, const void *data);
GLAPI void APIENTRY glBufferSubDataARB(GLenum target, GLintptrARB offset, GLsizeiptrARB size, const void *data);
GLAPI void APIENTRY glCallList(GLuint list);
GLAPI void APIENTRY glCallLists(GLsizei n, GLenum type, const GLvoid *lists);
GLAPI GLenum APIENTRY glCheckFramebufferStatusEXT(GLenum target);
GLAPI void APIENTRY glClear(GLbitfield mask);
GLAPI void APIENTRY glClearAccum(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha);
GLAPI void APIENTRY glClearColor(GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha);
GLAPI void APIENTRY glClearDepth(GLclampd depth);
GLAPI void APIENTRY glClearIndex(GLfloat c);
GLAPI void APIENTRY glClearStencil(GLint s);
GLAPI void APIENTRY glClientActiveTexture(GLenum texture);
GLAPI void APIENTRY glClientActiveTextureARB(GLenum texture);
GLAPI void APIENTRY glClipPlane(GLenum plane, const GLdouble *equation);
GLAPI void APIENTRY glColor3b(GLbyte red, GLbyte green, GLbyte blue);
GLAPI void APIENTRY glColor3bv(const GLbyte *v);
GLAPI void APIENTRY glColor3d(GLdouble red, GLdouble green, GLdouble blue);
GLAPI void APIENTRY glColor3dv(const GLdouble *v);
GLAPI void APIENTRY glColor3f(GLfloat red, GLfloat green, GLfloat blue);
GLAPI void APIENTRY glColor3fv(const GLfloat *v);
GLAPI void APIENTRY glColor3i(GLint red, GLint green, GLint blue);
GLAPI void APIENTRY glColor3iv(const GLint *v);
GLAPI void APIENTRY glColor3s(GLshort red, GLshort green, GLshort blue);
GLAPI void APIENTRY glColor3sv(const GLshort *v);
GLAPI void APIENTRY glColor3ub(GLubyte red, GLubyte green, GLubyte blue);
GLAPI void APIENTRY glColor3ubv(const GLubyte *v);
GLAPI void APIENTRY glColor3ui(GLuint red, GLuint green, GLuint blue);
GLAPI void APIENTRY glColor3uiv(const GLuint *v);
GLAPI void APIENTRY glColor3us(GLushort red, GLushort green, GLushort blue);
GLAPI void APIENTRY glColor3usv(const GLushort *v);
GLAPI void APIENTRY glColor4b(GLbyte red, GLbyte green, GLbyte blue, GLbyte alpha);
GLAPI void APIENTRY glColor4bv(const GLbyte *v);
GLAPI void APIENTRY glColor4d(GLdouble red, GLdouble green, GLdouble blue, GLdouble alpha);
GLAPI void APIENTRY glColor4dv(const GLdouble *v);
GLAPI void APIENTRY glColor4f(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha);
GLAPI void APIENTRY glColor4fv(const GLfloat *v);
GLAPI void APIENTRY glColor4i(GLint red, GLint green, GLint blue, GLint alpha);
GLAPI void APIENTRY glColor4iv(const GLint *v);
GLAPI void APIENTRY glColor4s(GLshort red, GLshort green, GLshort blue, GLshort alpha);
GLAPI void APIENTRY glColor4sv(const GLshort *v);
GLAPI void APIENTRY glColor4ub(GLubyte red, GLubyte green, GLubyte blue, GLubyte alpha);
GLAPI void APIENTRY glColor4ubv(const GLubyte *v);
GLAPI void APIENTRY glColor4ui(GLuint red, GLuint green, GLuint blue, GLuint alpha);
GLAPI void APIENTRY glColor4uiv(const GLuint *v);
GLAPI void APIENTRY glColor4us(GLushort red, GLushort green, GLushort blue, GLushort alpha);
GLAPI void APIENTRY glColor4usv(const GLushort *v);
GLAPI void APIENTRY glColorMask(GLboolean red, GLboolean green, GLboolean blue, GLboolean alpha);
GLAPI void APIENTRY glColorMaterial(GLenum face, GLenum mode);
GLAPI void APIENTRY glColorPointer(GLint size, GLenum type, GLsizei stride, const GLvoid *ptr);
GLAPI void APIENTRY glColorPointerEXT(GLint size, GLenum type, GLsizei stride, GLsizei count, const void *pointer);
GLAPI void APIENTRY glColorSubTable(GLenum target, GLsizei start, GLsizei count, GLenum format, GLenum type,
    const GLvoid *data);
GLAPI void APIENTRY glColorTable(GLenum target, GLenum internalformat, GLsizei width, GLenum format, GLenum type,
    const GLvoid *table);
GLAPI void APIENTRY glColorTableParameterfv(GLenum target, GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glColorTableParameteriv(GLenum target, GLenum pname, const GLint *params);
GLAPI void APIENTRY glCompressedTexImage1D(GLenum target, GLint level, GLenum internalformat, GLsizei width,
    GLint border, GLsizei imageSize, const GLvoid *data);
GLAPI void APIENTRY glCompressedTexImage1DARB(GLenum target, GLint level, GLenum internalformat, GLsizei width,
    GLint border, GLsizei imageSize, const void *data);
GLAPI void APIENTRY glCompressedTexImage2D(GLenum target, GLint level, GLenum internalformat, GLsizei width,
    GLsizei height, GLint border, GLsizei imageSize, const GLvoid *data);
GLAPI void APIENTRY glCompressedTexImage2DARB(GLenum target, GLint level, GLenum internalformat, GLsizei width,
    GLsizei height, GLint border, GLsizei imageSize, const void *data);
GLAPI void APIENTRY glCompressedTexImage3D(GLenum target, GLint level, GLenum internalformat, GLsizei width,
    GLsizei height, GLsizei depth, GLint border, GLsizei imageSize, const GLvoid *data);
GLAPI void APIENTRY glCompressedTexImage3DARB(GLenum target, GLint level, GLenum internalformat, GLsizei width,
    GLsizei height, GLsizei depth, GLint border, GLsizei imageSize, const void *data);
GLAPI void APIENTRY glCompressedTexSubImage1D(GLenum target, GLint level, GLint xoffset, GLsizei width, GLenum format,
    GLsizei imageSize, const GLvoid *data);
GLAPI void APIENTRY glCompressedTexSubImage1DARB(GLenum target, GLint level, GLint xoffset, GLsizei width,
    GLenum format, GLsizei imageSize, const void *data);
GLAPI void APIENTRY glCompressedTexSubImage2D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLsizei width,
    GLsizei height, GLenum format, GLsizei imageSize, const GLvoid *data);
GLAPI void APIENTRY glCompressedTexSubImage2DARB(GLenum target, GLint level, GLint xoffset, GLint yoffset,
    GLsizei width, GLsizei height, GLenum format, GLsizei imageSize, const void *data);
GLAPI void APIENTRY glCompressedTexSubImage3D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,
    GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLsizei imageSize, const GLvoid *data);
GLAPI void APIENTRY glCompressedTexSubImage3DARB(GLenum target, GLint level, GLint xoffset, GLint yoffset,
    GLint zoffset, GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLsizei imageSize, const void *data);
GLAPI void APIENTRY glConvolutionFilter1D(GLenum target, GLenum internalformat, GLsizei width, GLenum format,
    GLenum type, const GLvoid *image);
GLAPI void APIENTRY glConvolutionFilter2D(GLenum target, GLenum internalformat, GLsizei width, GLsizei height,
    GLenum format, GLenum type, const GLvoid *image);
GLAPI void APIENTRY glConvolutionParameterf(GLenum target, GLenum pname, GLfloat params);
GLAPI void APIENTRY glConvolutionParameterfv(GLenum target, GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glConvolutionParameteri(GLenum target, GLenum pname, GLint params);
GLAPI void APIENTRY glConvolutionParameteriv(GLenum target, GLenum pname, const GLint *params);
GLAPI void APIENTRY glCopyColorSubTable(GLenum target, GLsizei start, GLint x, GLint y, GLsizei width);
GLAPI void APIENTRY glCopyColorTable(GLenum target, GLenum internalformat, GLint x, GLint y, GLsizei width);
GLAPI void APIENTRY glCopyConvolutionFilter1D(GLenum target, GLenum internalformat, GLint x, GLint y, GLsizei width);
GLAPI void APIENTRY glCopyConvolutionFilter2D(GLenum target, GLenum internalformat, GLint x, GLint y, GLsizei width,
    GLsizei height);
GLAPI void APIENTRY glCopyPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum type);
GLAPI void APIENTRY glCopyTexImage1D(GLenum target, GLint level, GLenum internalformat, GLint x, GLint y,
    GLsizei width, GLint border);
GLAPI void APIENTRY glCopyTexImage1DEXT(GLenum target, GLint level, GLenum internalformat, GLint x, GLint y,
    GLsizei width, GLint border);
GLAPI void APIENTRY glCopyTexImage2D(GLenum target, GLint level, GLenum internalformat, GLint x, GLint y,
    GLsizei width, GLsizei height, GLint border);
GLAPI void APIENTRY glCopyTexImage2DEXT(GLenum target, GLint level, GLenum internalformat, GLint x, GLint y,
    GLsizei width, GLsizei height, GLint border);
GLAPI void APIENTRY glCopyTexSubImage1D(GLenum target, GLint level, GLint xoffset, GLint x, GLint y, GLsizei width);
GLAPI void APIENTRY glCopyTexSubImage1DEXT(GLenum target, GLint level, GLint xoffset, GLint x, GLint y, GLsizei width);
GLAPI void APIENTRY glCopyTexSubImage2D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint x, GLint y,
    GLsizei width, GLsizei height);
GLAPI void APIENTRY glCopyTexSubImage2DEXT(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint x, GLint y,
    GLsizei width, GLsizei height);
GLAPI void APIENTRY glCopyTexSubImage3D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,
    GLint x, GLint y, GLsizei width, GLsizei height);
GLAPI void APIENTRY glCopyTexSubImage3DEXT(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,
    GLint x, GLint y, GLsizei width, GLsizei height);
GLAPI void APIENTRY glCullFace(GLenum mode);
GLAPI void APIENTRY glDeleteBuffers(GLsizei n, const GLuint *buffers);
GLAPI void APIENTRY glDeleteBuffersARB(GLsizei n, const GLuint *buffers);
GLAPI void APIENTRY glDeleteFramebuffersEXT(GLsizei n, const GLuint *framebuffers);
GLAPI void APIENTRY glDeleteLists(GLuint list, GLsizei range);
GLAPI void APIENTRY glDeleteQueries(GLsizei n, const GLuint *ids);
GLAPI void APIENTRY glDeleteQueriesARB(GLsizei n, const GLuint *ids);
GLAPI void APIENTRY glDeleteRenderbuffersEXT(GLsizei n, const GLuint *renderbuffers);
GLAPI void APIENTRY glDeleteTextures(GLsizei n, const GLuint *textures);
GLAPI void APIENTRY glDeleteTexturesEXT(GLsizei n, const GLuint *textures);
GLAPI void APIENTRY glDepthFunc(GLenum func);
GLAPI void APIENTRY glDepthMask(GLboolean flag);
GLAPI void APIENTRY glDepthRange(GLclampd near_val, GLclampd far_val);
GLAPI void APIENTRY glDisable(GLenum cap);
GLAPI void APIENTRY glDisableClientState(GLenum cap);
GLAPI void APIENTRY glDrawArrays(GLenum mode, GLint first, GLsizei count);
GLAPI void APIENTRY glDrawArraysEXT(GLenum mode, GLint first, GLsizei count);
GLAPI void APIENTRY glDrawBuffer(GLenum mode);
GLAPI void APIENTRY glDrawElements(GLenum mode, GLsizei count, GLenum type, const GLvoid *indices);
GLAPI void APIENTRY glDrawPixels(GLsizei width, GLsizei height, GLenum format, GLenum type, const GLvoid *pixels);
GLAPI void APIENTRY glDrawRangeElements(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type,
    const GLvoid *indices);
GLAPI void APIENTRY glDrawRangeElementsEXT(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type,
    const void *indices);
GLAPI void APIENTRY glEdgeFlag(GLboolean flag);
GLAPI void APIENTRY glEdgeFlagPointer(GLsizei stride, const GLvoid *ptr);
GLAPI void APIENTRY glEdgeFlagPointerEXT(GLsizei stride, GLsizei count, const GLboolean *pointer);
GLAPI void APIENTRY glEdgeFlagv(const GLboolean *flag);
GLAPI void APIENTRY glEnable(GLenum cap);
GLAPI void APIENTRY glEnableClientState(GLenum cap);
GLAPI void APIENTRY glEnd(void);
GLAPI void APIENTRY glEndList(void);
GLAPI void APIENTRY glEndQuery(GLenum target);
GLAPI void APIENTRY glEndQueryARB(GLenum target);
GLAPI void APIENTRY glEvalCoord1d(GLdouble u);
GLAPI void APIENTRY glEvalCoord1dv(const GLdouble *u);
GLAPI void APIENTRY glEvalCoord1f(GLfloat u);
GLAPI void APIENTRY glEvalCoord1fv(const GLfloat *u);
GLAPI void APIENTRY glEvalCoord2d(GLdouble u, GLdouble v);
GLAPI void APIENTRY glEvalCoord2dv(const GLdouble *u);
GLAPI void APIENTRY glEvalCoord2f(GLfloat u, GLfloat v);
GLAPI void APIENTRY glEvalCoord2fv(const GLfloat *u);
GLAPI void APIENTRY glEvalMesh1(GLenum mode, GLint i1, GLint i2);
GLAPI void APIENTRY glEvalMesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);
GLAPI void APIENTRY glEvalPoint1(GLint i);
GLAPI void APIENTRY glEvalPoint2(GLint i, GLint j);
GLAPI void APIENTRY glFeedbackBuffer(GLsizei size, GLenum type, GLfloat *buffer);
GLAPI void APIENTRY glFinish(void);
GLAPI void APIENTRY glFlush(void);
GLAPI void APIENTRY glFogCoordPointer(GLenum type, GLsizei stride, const void *pointer);
GLAPI void APIENTRY glFogCoordPointerEXT(GLenum type, GLsizei stride, const void *pointer);
GLAPI void APIENTRY glFogCoordd(GLdouble coord);
GLAPI void APIENTRY glFogCoorddEXT(GLdouble coord);
GLAPI void APIENTRY glFogCoorddv(const GLdouble *coord);
GLAPI void APIENTRY glFogCoorddvEXT(const GLdouble *coord);
GLAPI void APIENTRY glFogCoordf(GLfloat coord);
GLAPI void APIENTRY glFogCoordfEXT(GLfloat coord);
GLAPI void APIENTRY glFogCoordfv(const GLfloat *coord);
GLAPI void APIENTRY glFogCoordfvEXT(const GLfloat *coord);
GLAPI void APIENTRY glFogf(GLenum pname, GLfloat param);
GLAPI void APIENTRY glFogfv(GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glFogi(GLenum pname, GLint param);
GLAPI void APIENTRY glFogiv(GLenum pname, const GLint *params);
GLAPI void APIENTRY glFramebufferRenderbufferEXT(GLenum target, GLenum attachment, GLenum renderbuffertarget,
    GLuint renderbuffer);
GLAPI void APIENTRY glFramebufferTexture1DEXT(GLenum target, GLenum attachment, GLenum textarget, GLuint texture,
    GLint level);
GLAPI void APIENTRY glFramebufferTexture2DEXT(GLenum target, GLenum attachment, GLenum textarget, GLuint texture,
    GLint level);
GLAPI void APIENTRY glFramebufferTexture3DEXT(GLenum target, GLenum attachment, GLenum textarget, GLuint texture,
    GLint level, GLint zoffset);
GLAPI void APIENTRY glFramebufferTextureLayer(GLenum target, GLenum attachment, GLuint texture, GLint level,
    GLint slice);
GLAPI void APIENTRY glFrontFace(GLenum mode);
GLAPI void APIENTRY glFrustum(GLdouble left, GLdouble right, GLdouble bottom, GLdouble top, GLdouble near_val,
    GLdouble far_val);
GLAPI void APIENTRY glGenBuffers(GLsizei n, GLuint *buffers);
GLAPI void APIENTRY glGenBuffersARB(GLsizei n, GLuint *buffers);
GLAPI void APIENTRY glGenFramebuffersEXT(GLsizei n, GLuint *framebuffers);
GLAPI GLuint APIENTRY glGenLists(GLsizei range);
GLAPI void APIENTRY glGenQueries(GLsizei n, GLuint *ids);
GLAPI void APIENTRY glGenQueriesARB(GLsizei n, GLuint *ids);
GLAPI void APIENTRY glGenRenderbuffersEXT(GLsizei n, GLuint *renderbuffers);
GLAPI void APIENTRY glGenTextures(GLsizei n, GLuint *textures);
GLAPI void APIENTRY glGenTexturesEXT(GLsizei n, GLuint *textures);
GLAPI void APIENTRY glGenerateMipmapEXT(GLenum target);
GLAPI void APIENTRY glGetBooleanv(GLenum pname, GLboolean *params);
GLAPI void APIENTRY glGetBufferParameteriv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetBufferParameterivARB(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetBufferPointerv(GLenum target, GLenum pname, void **params);
GLAPI void APIENTRY glGetBufferPointervARB(GLenum target, GLenum pname, void **params);
GLAPI void APIENTRY glGetBufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, void *data);
GLAPI void APIENTRY glGetBufferSubDataARB(GLenum target, GLintptrARB offset, GLsizeiptrARB size, void *data);
GLAPI void APIENTRY glGetClipPlane(GLenum plane, GLdouble *equation);
GLAPI void APIENTRY glGetColorTable(GLenum target, GLenum format, GLenum type, GLvoid *table);
GLAPI void APIENTRY glGetColorTableParameterfv(GLenum target, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetColorTableParameteriv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetCompressedTexImage(GLenum target, GLint lod, GLvoid *img);
GLAPI void APIENTRY glGetCompressedTexImageARB(GLenum target, GLint level, void *img);
GLAPI void APIENTRY glGetConvolutionFilter(GLenum target, GLenum format, GLenum type, GLvoid *image);
GLAPI void APIENTRY glGetConvolutionParameterfv(GLenum target, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetConvolutionParameteriv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetDoublev(GLenum pname, GLdouble *params);
GLAPI GLenum APIENTRY glGetError(void);
GLAPI void APIENTRY glGetFloatv(GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetFramebufferAttachmentParameterivEXT(GLenum target, GLenum attachment, GLenum pname,
    GLint *params);
GLAPI void APIENTRY glGetHistogram(GLenum target, GLboolean reset, GLenum format, GLenum type, GLvoid *values);
GLAPI void APIENTRY glGetHistogramParameterfv(GLenum target, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetHistogramParameteriv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetIntegerv(GLenum pname, GLint *params);
GLAPI void APIENTRY glGetLightfv(GLenum light, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetLightiv(GLenum light, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetMapdv(GLenum target, GLenum query, GLdouble *v);
GLAPI void APIENTRY glGetMapfv(GLenum target, GLenum query, GLfloat *v);
GLAPI void APIENTRY glGetMapiv(GLenum target, GLenum query, GLint *v);
GLAPI void APIENTRY glGetMaterialfv(GLenum face, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetMaterialiv(GLenum face, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetMinmax(GLenum target, GLboolean reset, GLenum format, GLenum types, GLvoid *values);
GLAPI void APIENTRY glGetMinmaxParameterfv(GLenum target, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetMinmaxParameteriv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetPixelMapfv(GLenum map, GLfloat *values);
GLAPI void APIENTRY glGetPixelMapuiv(GLenum map, GLuint *values);
GLAPI void APIENTRY glGetPixelMapusv(GLenum map, GLushort *values);
GLAPI void APIENTRY glGetPointerv(GLenum pname, GLvoid **params);
GLAPI void APIENTRY glGetPointervEXT(GLenum pname, void **params);
GLAPI void APIENTRY glGetPolygonStipple(GLubyte *mask);
GLAPI void APIENTRY glGetQueryObjectiv(GLuint id, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetQueryObjectivARB(GLuint id, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetQueryObjectuiv(GLuint id, GLenum pname, GLuint *params);
GLAPI void APIENTRY glGetQueryObjectuivARB(GLuint id, GLenum pname, GLuint *params);
GLAPI void APIENTRY glGetQueryiv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetQueryivARB(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetRenderbufferParameterivEXT(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetSeparableFilter(GLenum target, GLenum format, GLenum type, GLvoid *row, GLvoid *column,
    GLvoid *span);
GLAPI const GLubyte * APIENTRY glGetString(GLenum name);
GLAPI void APIENTRY glGetTexEnvfv(GLenum target, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetTexEnviv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetTexGendv(GLenum coord, GLenum pname, GLdouble *params);
GLAPI void APIENTRY glGetTexGenfv(GLenum coord, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetTexGeniv(GLenum coord, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetTexImage(GLenum target, GLint level, GLenum format, GLenum type, GLvoid *pixels);
GLAPI void APIENTRY glGetTexLevelParameterfv(GLenum target, GLint level, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetTexLevelParameteriv(GLenum target, GLint level, GLenum pname, GLint *params);
GLAPI void APIENTRY glGetTexParameterfv(GLenum target, GLenum pname, GLfloat *params);
GLAPI void APIENTRY glGetTexParameteriv(GLenum target, GLenum pname, GLint *params);
GLAPI void APIENTRY glHint(GLenum target, GLenum mode);
GLAPI void APIENTRY glHistogram(GLenum target, GLsizei width, GLenum internalformat, GLboolean sink);
GLAPI void APIENTRY glIndexMask(GLuint mask);
GLAPI void APIENTRY glIndexPointer(GLenum type, GLsizei stride, const GLvoid *ptr);
GLAPI void APIENTRY glIndexPointerEXT(GLenum type, GLsizei stride, GLsizei count, const void *pointer);
GLAPI void APIENTRY glIndexd(GLdouble c);
GLAPI void APIENTRY glIndexdv(const GLdouble *c);
GLAPI void APIENTRY glIndexf(GLfloat c);
GLAPI void APIENTRY glIndexfv(const GLfloat *c);
GLAPI void APIENTRY glIndexi(GLint c);
GLAPI void APIENTRY glIndexiv(const GLint *c);
GLAPI void APIENTRY glIndexs(GLshort c);
GLAPI void APIENTRY glIndexsv(const GLshort *c);
GLAPI void APIENTRY glIndexub(GLubyte c);
GLAPI void APIENTRY glIndexubv(const GLubyte *c);
GLAPI void APIENTRY glInitNames(void);
GLAPI void APIENTRY glInterleavedArrays(GLenum format, GLsizei stride, const GLvoid *pointer);
GLAPI GLboolean APIENTRY glIsBuffer(GLuint buffer);
GLAPI GLboolean APIENTRY glIsBufferARB(GLuint buffer);
GLAPI GLboolean APIENTRY glIsEnabled(GLenum cap);
GLAPI GLboolean APIENTRY glIsFramebufferEXT(GLuint framebuffer);
GLAPI GLboolean APIENTRY glIsList(GLuint list);
GLAPI GLboolean APIENTRY glIsQuery(GLuint id);
GLAPI GLboolean APIENTRY glIsQueryARB(GLuint id);
GLAPI GLboolean APIENTRY glIsRenderbufferEXT(GLuint renderbuffer);
GLAPI GLboolean APIENTRY glIsTexture(GLuint texture);
GLAPI GLboolean APIENTRY glIsTextureEXT(GLuint texture);
GLAPI void APIENTRY glLightModelf(GLenum pname, GLfloat param);
GLAPI void APIENTRY glLightModelfv(GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glLightModeli(GLenum pname, GLint param);
GLAPI void APIENTRY glLightModeliv(GLenum pname, const GLint *params);
GLAPI void APIENTRY glLightf(GLenum light, GLenum pname, GLfloat param);
GLAPI void APIENTRY glLightfv(GLenum light, GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glLighti(GLenum light, GLenum pname, GLint param);
GLAPI void APIENTRY glLightiv(GLenum light, GLenum pname, const GLint *params);
GLAPI void APIENTRY glLineStipple(GLint factor, GLushort pattern);
GLAPI void APIENTRY glLineWidth(GLfloat width);
GLAPI void APIENTRY glListBase(GLuint base);
GLAPI void APIENTRY glLoadIdentity(void);
GLAPI void APIENTRY glLoadMatrixd(const GLdouble *m);
GLAPI void APIENTRY glLoadMatrixf(const GLfloat *m);
GLAPI void APIENTRY glLoadName(GLuint name);
GLAPI void APIENTRY glLoadTransposeMatrixd(const GLdouble m[16]);
GLAPI void APIENTRY glLoadTransposeMatrixdARB(const GLdouble *m);
GLAPI void APIENTRY glLoadTransposeMatrixf(const GLfloat m[16]);
GLAPI void APIENTRY glLoadTransposeMatrixfARB(const GLfloat *m);
GLAPI void APIENTRY glLockArraysEXT(GLint first, GLsizei count);
GLAPI void APIENTRY glLogicOp(GLenum opcode);
GLAPI void APIENTRY glMap1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order, const GLdouble *points);
GLAPI void APIENTRY glMap1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat *points);
GLAPI void APIENTRY glMap2d(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
    GLdouble v2, GLint vstride, GLint vorder, const GLdouble *points);
GLAPI void APIENTRY glMap2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1,
    GLfloat v2, GLint vstride, GLint vorder, const GLfloat *points);
GLAPI void * APIENTRY glMapBuffer(GLenum target, GLenum access);
GLAPI void * APIENTRY glMapBufferARB(GLenum target, GLenum access);
GLAPI void APIENTRY glMapGrid1d(GLint un, GLdouble u1, GLdouble u2);
GLAPI void APIENTRY glMapGrid1f(GLint un, GLfloat u1, GLfloat u2);
GLAPI void APIENTRY glMapGrid2d(GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2);
GLAPI void APIENTRY glMapGrid2f(GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2);
GLAPI void APIENTRY glMaterialf(GLenum face, GLenum pname, GLfloat param);
GLAPI void APIENTRY glMaterialfv(GLenum face, GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glMateriali(GLenum face, GLenum pname, GLint param);
GLAPI void APIENTRY glMaterialiv(GLenum face, GLenum pname, const GLint *params);
GLAPI void APIENTRY glMatrixMode(GLenum mode);
GLAPI void APIENTRY glMinmax(GLenum target, GLenum internalformat, GLboolean sink);
GLAPI void APIENTRY glMultMatrixd(const GLdouble *m);
GLAPI void APIENTRY glMultMatrixf(const GLfloat *m);
GLAPI void APIENTRY glMultTransposeMatrixd(const GLdouble m[16]);
GLAPI void APIENTRY glMultTransposeMatrixdARB(const GLdouble *m);
GLAPI void APIENTRY glMultTransposeMatrixf(const GLfloat m[16]);
GLAPI void APIENTRY glMultTransposeMatrixfARB(const GLfloat *m);
GLAPI void APIENTRY glMultiDrawArrays(GLenum mode, const GLint *first, const GLsizei *count, GLsizei drawcount);
GLAPI void APIENTRY glMultiDrawArraysEXT(GLenum mode, const GLint *first, const GLsizei *count, GLsizei primcount);
GLAPI void APIENTRY glMultiDrawElements(GLenum mode, const GLsizei *count, GLenum type, const void *const*indices,
    GLsizei drawcount);
GLAPI void APIENTRY glMultiDrawElementsEXT(GLenum mode, const GLsizei *count, GLenum type, const void *const*indices,
    GLsizei primcount);
GLAPI void APIENTRY glMultiTexCoord1d(GLenum target, GLdouble s);
GLAPI void APIENTRY glMultiTexCoord1dARB(GLenum target, GLdouble s);
GLAPI void APIENTRY glMultiTexCoord1dv(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord1dvARB(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord1f(GLenum target, GLfloat s);
GLAPI void APIENTRY glMultiTexCoord1fARB(GLenum target, GLfloat s);
GLAPI void APIENTRY glMultiTexCoord1fv(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord1fvARB(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord1i(GLenum target, GLint s);
GLAPI void APIENTRY glMultiTexCoord1iARB(GLenum target, GLint s);
GLAPI void APIENTRY glMultiTexCoord1iv(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord1ivARB(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord1s(GLenum target, GLshort s);
GLAPI void APIENTRY glMultiTexCoord1sARB(GLenum target, GLshort s);
GLAPI void APIENTRY glMultiTexCoord1sv(GLenum target, const GLshort *v);
GLAPI void APIENTRY glMultiTexCoord1svARB(GLenum target, const GLshort *v);
GLAPI void APIENTRY glMultiTexCoord2d(GLenum target, GLdouble s, GLdouble t);
GLAPI void APIENTRY glMultiTexCoord2dARB(GLenum target, GLdouble s, GLdouble t);
GLAPI void APIENTRY glMultiTexCoord2dv(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord2dvARB(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord2f(GLenum target, GLfloat s, GLfloat t);
GLAPI void APIENTRY glMultiTexCoord2fARB(GLenum target, GLfloat s, GLfloat t);
GLAPI void APIENTRY glMultiTexCoord2fv(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord2fvARB(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord2i(GLenum target, GLint s, GLint t);
GLAPI void APIENTRY glMultiTexCoord2iARB(GLenum target, GLint s, GLint t);
GLAPI void APIENTRY glMultiTexCoord2iv(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord2ivARB(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord2s(GLenum target, GLshort s, GLshort t);
GLAPI void APIENTRY glMultiTexCoord2sARB(GLenum target, GLshort s, GLshort t);
GLAPI void APIENTRY glMultiTexCoord2sv(GLenum target, const GLshort *v);
GLAPI void APIENTRY glMultiTexCoord2svARB(GLenum target, const GLshort *v);
GLAPI void APIENTRY glMultiTexCoord3d(GLenum target, GLdouble s, GLdouble t, GLdouble r);
GLAPI void APIENTRY glMultiTexCoord3dARB(GLenum target, GLdouble s, GLdouble t, GLdouble r);
GLAPI void APIENTRY glMultiTexCoord3dv(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord3dvARB(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord3f(GLenum target, GLfloat s, GLfloat t, GLfloat r);
GLAPI void APIENTRY glMultiTexCoord3fARB(GLenum target, GLfloat s, GLfloat t, GLfloat r);
GLAPI void APIENTRY glMultiTexCoord3fv(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord3fvARB(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord3i(GLenum target, GLint s, GLint t, GLint r);
GLAPI void APIENTRY glMultiTexCoord3iARB(GLenum target, GLint s, GLint t, GLint r);
GLAPI void APIENTRY glMultiTexCoord3iv(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord3ivARB(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord3s(GLenum target, GLshort s, GLshort t, GLshort r);
GLAPI void APIENTRY glMultiTexCoord3sARB(GLenum target, GLshort s, GLshort t, GLshort r);
GLAPI void APIENTRY glMultiTexCoord3sv(GLenum target, const GLshort *v);
GLAPI void APIENTRY glMultiTexCoord3svARB(GLenum target, const GLshort *v);
GLAPI void APIENTRY glMultiTexCoord4d(GLenum target, GLdouble s, GLdouble t, GLdouble r, GLdouble q);
GLAPI void APIENTRY glMultiTexCoord4dARB(GLenum target, GLdouble s, GLdouble t, GLdouble r, GLdouble q);
GLAPI void APIENTRY glMultiTexCoord4dv(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord4dvARB(GLenum target, const GLdouble *v);
GLAPI void APIENTRY glMultiTexCoord4f(GLenum target, GLfloat s, GLfloat t, GLfloat r, GLfloat q);
GLAPI void APIENTRY glMultiTexCoord4fARB(GLenum target, GLfloat s, GLfloat t, GLfloat r, GLfloat q);
GLAPI void APIENTRY glMultiTexCoord4fv(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord4fvARB(GLenum target, const GLfloat *v);
GLAPI void APIENTRY glMultiTexCoord4i(GLenum target, GLint s, GLint t, GLint r, GLint q);
GLAPI void APIENTRY glMultiTexCoord4iARB(GLenum target, GLint s, GLint t, GLint r, GLint q);
GLAPI void APIENTRY glMultiTexCoord4iv(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord4ivARB(GLenum target, const GLint *v);
GLAPI void APIENTRY glMultiTexCoord4s(GLenum target, GLshort s, GLshort t, GLshort r, GLshort q);
GLAPI void APIENTRY glMultiTexCoord4sARB(GLenum target, GLshort s, GLshort t, GLshort r, GLshort q);
GLAPI void APIENTRY glMultiTexCoord4sv(GLenum target, const GLshort *v);
GLAPI void APIENTRY glMultiTexCoord4svARB(GLenum target, const GLshort *v);
GLAPI void APIENTRY glNewList(GLuint list, GLenum mode);
GLAPI void APIENTRY glNormal3b(GLbyte nx, GLbyte ny, GLbyte nz);
GLAPI void APIENTRY glNormal3bv(const GLbyte *v);
GLAPI void APIENTRY glNormal3d(GLdouble nx, GLdouble ny, GLdouble nz);
GLAPI void APIENTRY glNormal3dv(const GLdouble *v);
GLAPI void APIENTRY glNormal3f(GLfloat nx, GLfloat ny, GLfloat nz);
GLAPI void APIENTRY glNormal3fv(const GLfloat *v);
GLAPI void APIENTRY glNormal3i(GLint nx, GLint ny, GLint nz);
GLAPI void APIENTRY glNormal3iv(const GLint *v);
GLAPI void APIENTRY glNormal3s(GLshort nx, GLshort ny, GLshort nz);
GLAPI void APIENTRY glNormal3sv(const GLshort *v);
GLAPI void APIENTRY glNormalPointer(GLenum type, GLsizei stride, const GLvoid *ptr);
GLAPI void APIENTRY glNormalPointerEXT(GLenum type, GLsizei stride, GLsizei count, const void *pointer);
GLAPI void APIENTRY glOrtho(GLdouble left, GLdouble right, GLdouble bottom, GLdouble top, GLdouble near_val,
    GLdouble far_val);
GLAPI void APIENTRY glPassThrough(GLfloat token);
GLAPI void APIENTRY glPixelMapfv(GLenum map, GLsizei mapsize, const GLfloat *values);
GLAPI void APIENTRY glPixelMapuiv(GLenum map, GLsizei mapsize, const GLuint *values);
GLAPI void APIENTRY glPixelMapusv(GLenum map, GLsizei mapsize, const GLushort *values);
GLAPI void APIENTRY glPixelStoref(GLenum pname, GLfloat param);
GLAPI void APIENTRY glPixelStorei(GLenum pname, GLint param);
GLAPI void APIENTRY glPixelTransferf(GLenum pname, GLfloat param);
GLAPI void APIENTRY glPixelTransferi(GLenum pname, GLint param);
GLAPI void APIENTRY glPixelZoom(GLfloat xfactor, GLfloat yfactor);
GLAPI void APIENTRY glPointParameterf(GLenum pname, GLfloat param);
GLAPI void APIENTRY glPointParameterfARB(GLenum pname, GLfloat param);
GLAPI void APIENTRY glPointParameterfEXT(GLenum pname, GLfloat param);
GLAPI void APIENTRY glPointParameterfv(GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glPointParameterfvARB(GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glPointParameterfvEXT(GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glPointParameteri(GLenum pname, GLint param);
GLAPI void APIENTRY glPointParameteriv(GLenum pname, const GLint *params);
GLAPI void APIENTRY glPointSize(GLfloat size);
GLAPI void APIENTRY glPolygonMode(GLenum face, GLenum mode);
GLAPI void APIENTRY glPolygonOffset(GLfloat factor, GLfloat units);
GLAPI void APIENTRY glPolygonOffsetEXT(GLfloat factor, GLfloat bias);
GLAPI void APIENTRY glPolygonStipple(const GLubyte *mask);
GLAPI void APIENTRY glPopAttrib(void);
GLAPI void APIENTRY glPopClientAttrib(void);
GLAPI void APIENTRY glPopMatrix(void);
GLAPI void APIENTRY glPopName(void);
GLAPI void APIENTRY glPrioritizeTextures(GLsizei n, const GLuint *textures, const GLclampf *priorities);
GLAPI void APIENTRY glPrioritizeTexturesEXT(GLsizei n, const GLuint *textures, const GLclampf *priorities);
GLAPI void APIENTRY glPushAttrib(GLbitfield mask);
GLAPI void APIENTRY glPushClientAttrib(GLbitfield mask);
GLAPI void APIENTRY glPushMatrix(void);
GLAPI void APIENTRY glPushName(GLuint name);
GLAPI void APIENTRY glRasterPos2d(GLdouble x, GLdouble y);
GLAPI void APIENTRY glRasterPos2dv(const GLdouble *v);
GLAPI void APIENTRY glRasterPos2f(GLfloat x, GLfloat y);
GLAPI void APIENTRY glRasterPos2fv(const GLfloat *v);
GLAPI void APIENTRY glRasterPos2i(GLint x, GLint y);
GLAPI void APIENTRY glRasterPos2iv(const GLint *v);
GLAPI void APIENTRY glRasterPos2s(GLshort x, GLshort y);
GLAPI void APIENTRY glRasterPos2sv(const GLshort *v);
GLAPI void APIENTRY glRasterPos3d(GLdouble x, GLdouble y, GLdouble z);
GLAPI void APIENTRY glRasterPos3dv(const GLdouble *v);
GLAPI void APIENTRY glRasterPos3f(GLfloat x, GLfloat y, GLfloat z);
GLAPI void APIENTRY glRasterPos3fv(const GLfloat *v);
GLAPI void APIENTRY glRasterPos3i(GLint x, GLint y, GLint z);
GLAPI void APIENTRY glRasterPos3iv(const GLint *v);
GLAPI void APIENTRY glRasterPos3s(GLshort x, GLshort y, GLshort z);
GLAPI void APIENTRY glRasterPos3sv(const GLshort *v);
GLAPI void APIENTRY glRasterPos4d(GLdouble x, GLdouble y, GLdouble z, GLdouble w);
GLAPI void APIENTRY glRasterPos4dv(const GLdouble *v);
GLAPI void APIENTRY glRasterPos4f(GLfloat x, GLfloat y, GLfloat z, GLfloat w);
GLAPI void APIENTRY glRasterPos4fv(const GLfloat *v);
GLAPI void APIENTRY glRasterPos4i(GLint x, GLint y, GLint z, GLint w);
GLAPI void APIENTRY glRasterPos4iv(const GLint *v);
GLAPI void APIENTRY glRasterPos4s(GLshort x, GLshort y, GLshort z, GLshort w);
GLAPI void APIENTRY glRasterPos4sv(const GLshort *v);
GLAPI void APIENTRY glReadBuffer(GLenum mode);
GLAPI void APIENTRY glReadPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
    GLvoid *pixels);
GLAPI void APIENTRY glRectd(GLdouble x1, GLdouble y1, GLdouble x2, GLdouble y2);
GLAPI void APIENTRY glRectdv(const GLdouble *v1, const GLdouble *v2);
GLAPI void APIENTRY glRectf(GLfloat x1, GLfloat y1, GLfloat x2, GLfloat y2);
GLAPI void APIENTRY glRectfv(const GLfloat *v1, const GLfloat *v2);
GLAPI void APIENTRY glRecti(GLint x1, GLint y1, GLint x2, GLint y2);
GLAPI void APIENTRY glRectiv(const GLint *v1, const GLint *v2);
GLAPI void APIENTRY glRects(GLshort x1, GLshort y1, GLshort x2, GLshort y2);
GLAPI void APIENTRY glRectsv(const GLshort *v1, const GLshort *v2);
GLAPI GLint APIENTRY glRenderMode(GLenum mode);
GLAPI void APIENTRY glRenderbufferStorageEXT(GLenum target, GLenum internalformat, GLsizei width, GLsizei height);
GLAPI void APIENTRY glRenderbufferStorageMultisample(GLenum target, GLsizei samples, GLenum format, GLsizei width,
    GLsizei height);
GLAPI void APIENTRY glResetHistogram(GLenum target);
GLAPI void APIENTRY glResetMinmax(GLenum target);
GLAPI void APIENTRY glRotated(GLdouble angle, GLdouble x, GLdouble y, GLdouble z);
GLAPI void APIENTRY glRotatef(GLfloat angle, GLfloat x, GLfloat y, GLfloat z);
GLAPI void APIENTRY glSampleCoverage(GLclampf value, GLboolean invert);
GLAPI void APIENTRY glSampleCoverageARB(GLfloat value, GLboolean invert);
GLAPI void APIENTRY glScaled(GLdouble x, GLdouble y, GLdouble z);
GLAPI void APIENTRY glScalef(GLfloat x, GLfloat y, GLfloat z);
GLAPI void APIENTRY glScissor(GLint x, GLint y, GLsizei width, GLsizei height);
GLAPI void APIENTRY glSecondaryColor3b(GLbyte red, GLbyte green, GLbyte blue);
GLAPI void APIENTRY glSecondaryColor3bEXT(GLbyte red, GLbyte green, GLbyte blue);
GLAPI void APIENTRY glSecondaryColor3bv(const GLbyte *v);
GLAPI void APIENTRY glSecondaryColor3bvEXT(const GLbyte *v);
GLAPI void APIENTRY glSecondaryColor3d(GLdouble red, GLdouble green, GLdouble blue);
GLAPI void APIENTRY glSecondaryColor3dEXT(GLdouble red, GLdouble green, GLdouble blue);
GLAPI void APIENTRY glSecondaryColor3dv(const GLdouble *v);
GLAPI void APIENTRY glSecondaryColor3dvEXT(const GLdouble *v);
GLAPI void APIENTRY glSecondaryColor3f(GLfloat red, GLfloat green, GLfloat blue);
GLAPI void APIENTRY glSecondaryColor3fEXT(GLfloat red, GLfloat green, GLfloat blue);
GLAPI void APIENTRY glSecondaryColor3fv(const GLfloat *v);
GLAPI void APIENTRY glSecondaryColor3fvEXT(const GLfloat *v);
GLAPI void APIENTRY glSecondaryColor3i(GLint red, GLint green, GLint blue);
GLAPI void APIENTRY glSecondaryColor3iEXT(GLint red, GLint green, GLint blue);
GLAPI void APIENTRY glSecondaryColor3iv(const GLint *v);
GLAPI void APIENTRY glSecondaryColor3ivEXT(const GLint *v);
GLAPI void APIENTRY glSecondaryColor3s(GLshort red, GLshort green, GLshort blue);
GLAPI void APIENTRY glSecondaryColor3sEXT(GLshort red, GLshort green, GLshort blue);
GLAPI void APIENTRY glSecondaryColor3sv(const GLshort *v);
GLAPI void APIENTRY glSecondaryColor3svEXT(const GLshort *v);
GLAPI void APIENTRY glSecondaryColor3ub(GLubyte red, GLubyte green, GLubyte blue);
GLAPI void APIENTRY glSecondaryColor3ubEXT(GLubyte red, GLubyte green, GLubyte blue);
GLAPI void APIENTRY glSecondaryColor3ubv(const GLubyte *v);
GLAPI void APIENTRY glSecondaryColor3ubvEXT(const GLubyte *v);
GLAPI void APIENTRY glSecondaryColor3ui(GLuint red, GLuint green, GLuint blue);
GLAPI void APIENTRY glSecondaryColor3uiEXT(GLuint red, GLuint green, GLuint blue);
GLAPI void APIENTRY glSecondaryColor3uiv(const GLuint *v);
GLAPI void APIENTRY glSecondaryColor3uivEXT(const GLuint *v);
GLAPI void APIENTRY glSecondaryColor3us(GLushort red, GLushort green, GLushort blue);
GLAPI void APIENTRY glSecondaryColor3usEXT(GLushort red, GLushort green, GLushort blue);
GLAPI void APIENTRY glSecondaryColor3usv(const GLushort *v);
GLAPI void APIENTRY glSecondaryColor3usvEXT(const GLushort *v);
GLAPI void APIENTRY glSecondaryColorPointer(GLint size, GLenum type, GLsizei stride, const void *pointer);
GLAPI void APIENTRY glSecondaryColorPointerEXT(GLint size, GLenum type, GLsizei stride, const void *pointer);
GLAPI void APIENTRY glSelectBuffer(GLsizei size, GLuint *buffer);
GLAPI void APIENTRY glSeparableFilter2D(GLenum target, GLenum internalformat, GLsizei width, GLsizei height,
    GLenum format, GLenum type, const GLvoid *row, const GLvoid *column);
GLAPI void APIENTRY glShadeModel(GLenum mode);
GLAPI void APIENTRY glStencilFunc(GLenum func, GLint ref, GLuint mask);
GLAPI void APIENTRY glStencilMask(GLuint mask);
GLAPI void APIENTRY glStencilOp(GLenum fail, GLenum zfail, GLenum zpass);
GLAPI void APIENTRY glTexCoord1d(GLdouble s);
GLAPI void APIENTRY glTexCoord1dv(const GLdouble *v);
GLAPI void APIENTRY glTexCoord1f(GLfloat s);
GLAPI void APIENTRY glTexCoord1fv(const GLfloat *v);
GLAPI void APIENTRY glTexCoord1i(GLint s);
GLAPI void APIENTRY glTexCoord1iv(const GLint *v);
GLAPI void APIENTRY glTexCoord1s(GLshort s);
GLAPI void APIENTRY glTexCoord1sv(const GLshort *v);
GLAPI void APIENTRY glTexCoord2d(GLdouble s, GLdouble t);
GLAPI void APIENTRY glTexCoord2dv(const GLdouble *v);
GLAPI void APIENTRY glTexCoord2f(GLfloat s, GLfloat t);
GLAPI void APIENTRY glTexCoord2fv(const GLfloat *v);
GLAPI void APIENTRY glTexCoord2i(GLint s, GLint t);
GLAPI void APIENTRY glTexCoord2iv(const GLint *v);
GLAPI void APIENTRY glTexCoord2s(GLshort s, GLshort t);
GLAPI void APIENTRY glTexCoord2sv(const GLshort *v);
GLAPI void APIENTRY glTexCoord3d(GLdouble s, GLdouble t, GLdouble r);
GLAPI void APIENTRY glTexCoord3dv(const GLdouble *v);
GLAPI void APIENTRY glTexCoord3f(GLfloat s, GLfloat t, GLfloat r);
GLAPI void APIENTRY glTexCoord3fv(const GLfloat *v);
GLAPI void APIENTRY glTexCoord3i(GLint s, GLint t, GLint r);
GLAPI void APIENTRY glTexCoord3iv(const GLint *v);
GLAPI void APIENTRY glTexCoord3s(GLshort s, GLshort t, GLshort r);
GLAPI void APIENTRY glTexCoord3sv(const GLshort *v);
GLAPI void APIENTRY glTexCoord4d(GLdouble s, GLdouble t, GLdouble r, GLdouble q);
GLAPI void APIENTRY glTexCoord4dv(const GLdouble *v);
GLAPI void APIENTRY glTexCoord4f(GLfloat s, GLfloat t, GLfloat r, GLfloat q);
GLAPI void APIENTRY glTexCoord4fv(const GLfloat *v);
GLAPI void APIENTRY glTexCoord4i(GLint s, GLint t, GLint r, GLint q);
GLAPI void APIENTRY glTexCoord4iv(const GLint *v);
GLAPI void APIENTRY glTexCoord4s(GLshort s, GLshort t, GLshort r, GLshort q);
GLAPI void APIENTRY glTexCoord4sv(const GLshort *v);
GLAPI void APIENTRY glTexCoordPointer(GLint size, GLenum type, GLsizei stride, const GLvoid *ptr);
GLAPI void APIENTRY glTexCoordPointerEXT(GLint size, GLenum type, GLsizei stride, GLsizei count, const void *pointer);
GLAPI void APIENTRY glTexEnvf(GLenum target, GLenum pname, GLfloat param);
GLAPI void APIENTRY glTexEnvfv(GLenum target, GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glTexEnvi(GLenum target, GLenum pname, GLint param);
GLAPI void APIENTRY glTexEnviv(GLenum target, GLenum pname, const GLint *params);
GLAPI void APIENTRY glTexGend(GLenum coord, GLenum pname, GLdouble param);
GLAPI void APIENTRY glTexGendv(GLenum coord, GLenum pname, const GLdouble *params);
GLAPI void APIENTRY glTexGenf(GLenum coord, GLenum pname, GLfloat param);
GLAPI void APIENTRY glTexGenfv(GLenum coord, GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glTexGeni(GLenum coord, GLenum pname, GLint param);
GLAPI void APIENTRY glTexGeniv(GLenum coord, GLenum pname, const GLint *params);
GLAPI void APIENTRY glTexImage1D(GLenum target, GLint level, GLint internalFormat, GLsizei width, GLint border,
    GLenum format, GLenum type, const GLvoid *pixels);
GLAPI void APIENTRY glTexImage2D(GLenum target, GLint level, GLint internalFormat, GLsizei width, GLsizei height,
    GLint border, GLenum format, GLenum type, const GLvoid *pixels);
GLAPI void APIENTRY glTexImage3D(GLenum target, GLint level, GLint internalFormat, GLsizei width, GLsizei height,
    GLsizei depth, GLint border, GLenum format, GLenum type, const GLvoid *pixels);
GLAPI void APIENTRY glTexImage3DEXT(GLenum target, GLint level, GLenum internalformat, GLsizei width, GLsizei height,
    GLsizei depth, GLint border, GLenum format, GLenum type, const void *pixels);
GLAPI void APIENTRY glTexParameterf(GLenum target, GLenum pname, GLfloat param);
GLAPI void APIENTRY glTexParameterfv(GLenum target, GLenum pname, const GLfloat *params);
GLAPI void APIENTRY glTexParameteri(GLenum target, GLenum pname, GLint param);
GLAPI void APIENTRY glTexParameteriv(GLenum target, GLenum pname, const GLint *params);
GLAPI void APIENTRY glTexSubImage1D(GLenum target, GLint level, GLint xoffset, GLsizei width, GLenum format,
    GLenum type, const GLvoid *pixels);
GLAPI void APIENTRY glTexSubImage1DEXT(GLenum target, GLint level, GLint xoffset, GLsizei width, GLenum format,
    GLenum type, const void *pixels);
GLAPI void APIENTRY glTexSubImage2D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLsizei width,
    GLsizei height, GLenum format, GLenum type, const GLvoid *pixels);
GLAPI void APIENTRY glTexSubImage2DEXT(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLsizei width,
    GLsizei height, GLenum format, GLenum type, const void *pixels);
GLAPI void APIENTRY glTexSubImage3D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,
    GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLenum type, const GLvoid *pixels);
GLAPI void APIENTRY glTexSubImage3DEXT(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,
    GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLenum type, const void *pixels);
GLAPI void APIENTRY glTranslated(GLdouble x, GLdouble y, GLdouble z);
GLAPI void APIENTRY glTranslatef(GLfloat x, GLfloat y, GLfloat z);
GLAPI void APIENTRY glUnlockArraysEXT(void);
GLAPI GLboolean APIENTRY glUnmapBuffer(GLenum target);
GLAPI GLboolean APIENTRY glUnmapBufferARB(GLenum target);
GLAPI void APIENTRY glVertex2d(GLdouble x, GLdouble y);
GLAPI void APIENTRY glVertex2dv(const GLdouble *v);
GLAPI void APIENTRY glVertex2f(GLfloat x, GLfloat y);
GLAPI void APIENTRY glVertex2fv(const GLfloat *v);
GLAPI void APIENTRY glVertex2i(GLint x, GLint y);
GLAPI void APIENTRY glVertex2iv(const GLint *v);
GLAPI void APIENTRY glVertex2s(GLshort x, GLshort y);
GLAPI void APIENTRY glVertex2sv(const GLshort *v);
GLAPI void APIENTRY glVertex3d(GLdouble x, GLdouble y, GLdouble z);
GLAPI void APIENTRY glVertex3dv(const GLdouble *v);
GLAPI void APIENTRY glVertex3f(GLfloat x, GLfloat y, GLfloat z);
GLAPI void APIENTRY glVertex3fv(const GLfloat *v);
GLAPI void APIENTRY glVertex3i(GLint x, GLint y, GLint z);
GLAPI void APIENTRY glVertex3iv(const GLint *v);
GLAPI void APIENTRY glVertex3s(GLshort x, GLshort y, GLshort z);
GLAPI void APIENTRY glVertex3sv(const GLshort *v);
GLAPI void APIENTRY glVertex4d(GLdouble x, GLdouble y, GLdouble z, GLdouble w);
GLAPI void APIENTRY glVertex4dv(const GLdouble *v);
GLAPI void APIENTRY glVertex4f(GLfloat x, GLfloat y, GLfloat z, GLfloat w);
GLAPI void APIENTRY glVertex4fv(const GLfloat *v);
GLAPI void APIENTRY glVertex4i(GLint x, GLint y, GLint z, GLint w);
GLAPI void APIENTRY glVertex4iv(const GLint *v);
GLAPI void APIENTRY glVertex4s(GLshort x, GLshort y, GLshort z, GLshort w);
GLAPI void APIENTRY glVertex4sv(const GLshort *v);
GLAPI void APIENTRY glVertexPointer(GLint size, GLenum type, GLsizei stride, const GLvoid *ptr);
GLAPI void APIENTRY glVertexPointerEXT(GLint size, GLenum type, GLsizei stride, GLsizei count, const void *pointer);
GLAPI void APIENTRY glViewport(GLint x, GLint y, GLsizei width, GLsizei height);
GLAPI void APIENTRY glWindowPos2d(GLdouble x, GLdouble y);
GLAPI void APIENTRY glWindowPos2dARB(GLdouble x, GLdouble y);
GLAPI void APIENTRY glWindowPos2dv(const GLdouble *v);
GLAPI void APIENTRY glWindowPos2dvARB(const GLdouble *v);
GLAPI void APIENTRY glWindowPos2f(GLfloat x, GLfloat y);
GLAPI void APIENTRY glWindowPos2fARB(GLfloat x, GLfloat y);
GLAPI void APIENTRY glWindowPos2fv(const GLfloat *v);
GLAPI void APIENTRY glWindowPos2fvARB(const GLfloat *v);
GLAPI void APIENTRY glWindowPos2i(GLint x, GLint y);
GLAPI void APIENTRY glWindowPos2iARB(GLint x, GLint y);
GLAPI void APIENTRY glWindowPos2iv(const GLint *v);
GLAPI void APIENTRY glWindowPos2ivARB(const GLint *v);
GLAPI void APIENTRY glWindowPos2s(GLshort x, GLshort y);
GLAPI void APIENTRY glWindowPos2sARB(GLshort x, GLshort y);
GLAPI void APIENTRY glWindowPos2sv(const GLshort *v);
GLAPI void APIENTRY glWindowPos2svARB(const GLshort *v);
GLAPI void APIENTRY glWindowPos3d(GLdouble x, GLdouble y, GLdouble z);
GLAPI void APIENTRY glWindowPos3dARB(GLdouble x, GLdouble y, GLdouble z);
GLAPI void APIENTRY glWindowPos3dv(const GLdouble *v);
GLAPI void APIENTRY glWindowPos3dvARB(const GLdouble *v);
GLAPI void APIENTRY glWindowPos3f(GLfloat x, GLfloat y, GLfloat z);
GLAPI void APIENTRY glWindowPos3fARB(GLfloat x, GLfloat y, GLfloat z);
GLAPI void APIENTRY glWindowPos3fv(const GLfloat *v);
GLAPI void APIENTRY glWindowPos3fvARB(const GLfloat *v);
GLAPI void APIENTRY glWindowPos3i(GLint x, GLint y, GLint z);
GLAPI void APIENTRY glWindowPos3iARB(GLint x, GLint y, GLint z);
GLAPI void APIENTRY glWindowPos3iv(const GLint *v);
GLAPI void APIENTRY glWindowPos3ivARB(const GLint *v);
GLAPI void APIENTRY glWindowPos3s(GLshort x, GLshort y, GLshort z);
GLAPI void APIENTRY glWindowPos3sARB(GLshort x, GLshort y, GLshort z);
GLAPI void APIENTRY glWindowPos3sv(const GLshort *v);
GLAPI void APIENTRY glWindowPos3svARB(const GLshort *v);

#ifdef __cplusplus
}
#endif
#endif

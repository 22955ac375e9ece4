/* io_gltf_material.c: the glTF materials, textures, samplers and images that a Lambertian renderer can use. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

enum { GL_NEAREST = 9728, GL_LINEAR = 9729, GL_CLAMP = 33071, GL_MIRROR = 33648 };

/* A sampler has two filters, lambent one. Pixel art (magnified by nearest) stays sharp. Mips are made if the
 * minifying filter names them, or if none is given. */
static uint8_t filter_of(uint32_t mag, uint32_t min)
{
    if (mag == GL_NEAREST)
        return LMB_NEAREST;
    if (min == GL_NEAREST)
        return mag == GL_LINEAR ? LMB_BILINEAR : LMB_NEAREST;
    return min == GL_LINEAR ? LMB_BILINEAR : LMB_TRILINEAR;
}

static uint8_t wrap_of(uint32_t wrap)
{
    return wrap == GL_CLAMP ? LMB_WRAP_CLAMP : wrap == GL_MIRROR ? LMB_WRAP_MIRROR : LMB_WRAP_REPEAT;
}

static int read_sampler(lmb_texture *out, gltf *g, uint32_t texture)
{
    const json *doc = &g->doc;
    uint32_t sampler, mag = 0, min = 0, s = 0, t = 0;
    if (!gltf_item(&sampler, g, &g->samplers, json_member(doc, texture, "sampler")) ||
        !json_read_uint(&mag, doc, json_member(doc, sampler, "magFilter"), g->b->r) ||
        !json_read_uint(&min, doc, json_member(doc, sampler, "minFilter"), g->b->r) ||
        !json_read_uint(&s, doc, json_member(doc, sampler, "wrapS"), g->b->r) ||
        !json_read_uint(&t, doc, json_member(doc, sampler, "wrapT"), g->b->r))
        return 0;
    out->filter = filter_of(mag, min);
    out->wrap_s = wrap_of(s);
    out->wrap_t = wrap_of(t);
    return 1;
}

/* Sets `place` to the name of the file, if the image has one. */
int gltf_image_bytes(gltf_bytes *out, char place[GLTF_PLACE], gltf *g, uint32_t index, report *why)
{
    const uint32_t node = g->images.items[index], reference = json_member(&g->doc, node, "bufferView");
    uint32_t view;
    snprintf(place, GLTF_PLACE, "images[%u]", (unsigned)index); /* json_path would count the images before it */
    if (reference == JSON_NONE) {
        const uint32_t uri = json_member(&g->doc, node, "uri");
        char file[64];
        json_string(file, sizeof file, &g->doc, uri);
        if (file[0] != '\0' && strncmp(file, "data:", 5) != 0)
            snprintf(place, GLTF_PLACE, "images[%u], %s", (unsigned)index, file);
        if (!gltf_uri(out, g, uri, why))
            return 0;
    } else if (!gltf_item(&view, g, &g->views, reference) || !gltf_view(out, g, view)) {
        return 0;
    }
    return 1;
}

/* Decodes images[index], with mip levels for `kind` if wanted; keeps it for the next texture of that kind. */
static int image_decode(lmb_texture *out, gltf *g, uint32_t index, int kind, int mips, report *why)
{
    lmb_texture *known = &g->image_texels[kind - 1][index];
    gltf_bytes bytes = {NULL, 0, 0};
    char place[GLTF_PLACE];
    int ok;
    if (!known->texels || (mips && known->levels == 1)) {
        if (!gltf_image_bytes(&bytes, place, g, index, why))
            return 0;
        ok = build_texels(g->b, known, bytes.data, bytes.size, mips ? kind : TEXELS_PLAIN, place,
                          &g->image_content[index], why);
        if (!ok)
            return 0;
    }
    out->texels = known->texels;
    out->width = known->width;
    out->height = known->height;
    out->levels = mips ? known->levels : 1;
    return 1;
}

/* A missing texture or image is a note, unless the model itself is damaged. */
static int leave_out(gltf *g, const report *why)
{
    if (g->b->r->text[0])
        return 0;
    if (g->left_out.textures++ == 0)
        g->texture_error = *why;
    return 1;
}

/* The image of a texture, without that of an extension that only other formats need. */
static int texture_image(uint32_t *out, gltf *g, uint32_t texture)
{
    return gltf_index(out, g, &g->images, json_member(&g->doc, texture, "source"));
}

static void measure(gltf_mean *out, const bitmap *map)
{
    const size_t n = (size_t)map->width * (size_t)map->height;
    uint64_t counts[4][256];
    size_t i;
    int k, code;
    memset(counts, 0, sizeof counts);
    memset(out, 0, sizeof *out);
    for (i = 0; i < n; ++i)
        for (k = 0; k < 4; ++k)
            ++counts[k][map->texels[4 * i + (size_t)k]];
    for (code = 0; code < 256; ++code) {
        out->green += code / 255.0 * (double)counts[1][code] / (double)n;
        out->blue += code / 255.0 * (double)counts[2][code] / (double)n;
        out->alpha += code / 255.0 * (double)counts[3][code] / (double)n;
        for (k = 0; k < 3; ++k)
            out->light[k] += srgb_decode(code) * (double)counts[k][code] / (double)n;
    }
    out->known = 1;
}

enum { SLOT_UNKNOWN = -1, SLOT_NONE = -2 };

/* Index in the scene of textures[index] as an image of that kind: made at first use; -1 if it is not available. */
static int texture_slot(int32_t *out, gltf *g, uint32_t index, int kind)
{
    const uint32_t node = g->textures.items[index];
    int32_t *slot = &g->slots[kind - 1][index];
    lmb_texture made;
    uint32_t source;
    report why;
    if (*slot == SLOT_UNKNOWN) {
        memset(&made, 0, sizeof made);
        why.text[0] = '\0';
        *slot = SLOT_NONE;
        if (!read_sampler(&made, g, node) || !texture_image(&source, g, node))
            return 0;
        if (source == JSON_NONE) {
            report_fail(&why, "%s: textures[%u]: no PNG or JPEG source", g->b->path, (unsigned)index);
            if (!leave_out(g, &why))
                return 0;
        } else if (image_decode(&made, g, source, kind, made.filter == LMB_TRILINEAR, &why)) {
            *slot = (int32_t)g->b->texture_count;
            g->b->textures[g->b->texture_count++] = made;
        } else if (!leave_out(g, &why)) {
            return 0;
        }
    }
    *out = *slot < 0 ? -1 : *slot;
    return 1;
}

int gltf_texture(int32_t *out, gltf *g, uint32_t texture) { return texture_slot(out, g, texture, TEXELS_COLOUR); }

/* KHR_texture_transform: u' = offset + rotation * scale * u. The rotation is counter-clockwise with v downwards, as
 * in the viewers and test models that agree on it; the extension's own GLSL text turns the other way. */
static int read_transform(gltf_uv *uv, gltf *g, uint32_t transform)
{
    const json *doc = &g->doc;
    double offset[2] = {0, 0}, scale[2] = {1, 1}, angle = 0, c, s;
    if (!json_read_doubles(offset, 2, doc, json_member(doc, transform, "offset"), g->b->r) ||
        !json_read_doubles(scale, 2, doc, json_member(doc, transform, "scale"), g->b->r) ||
        !json_read_double(&angle, doc, json_member(doc, transform, "rotation"), g->b->r) ||
        !json_read_uint(&uv->set, doc, json_member(doc, transform, "texCoord"), g->b->r))
        return 0;
    c = cos(angle);
    s = sin(angle);
    uv->m[0] = c * scale[0];
    uv->m[1] = s * scale[1];
    uv->m[2] = offset[0];
    uv->m[3] = -s * scale[0];
    uv->m[4] = c * scale[1];
    uv->m[5] = offset[1];
    uv->moved = angle != 0 || offset[0] != 0 || offset[1] != 0 || scale[0] != 1 || scale[1] != 1;
    return 1;
}

int gltf_read_uv(gltf_uv *out, gltf *g, uint32_t info)
{
    const json *doc = &g->doc;
    const uint32_t transform = json_member(doc, json_member(doc, info, "extensions"), "KHR_texture_transform");
    memset(out, 0, sizeof *out);
    return json_read_uint(&out->set, doc, json_member(doc, info, "texCoord"), g->b->r) &&
           (transform == JSON_NONE || read_transform(out, g, transform));
}

/* Reads a texture info: the index of the image of that kind, -1: not available, and the mapping of texture
 * coordinates. */
static int read_texture(int32_t *slot, gltf_uv *uv, gltf *g, uint32_t info, int kind)
{
    const json *doc = &g->doc;
    const uint32_t reference = json_member(doc, info, "index");
    uint32_t index;
    memset(uv, 0, sizeof *uv);
    uv->set = JSON_NONE;
    if (info == JSON_NONE)
        return 1;
    if (reference == JSON_NONE)
        return json_fail(doc, info, g->b->r, "index is missing");
    if (!gltf_index(&index, g, &g->textures, reference) || !texture_slot(slot, g, index, kind))
        return 0;
    if (*slot < 0)
        return 1;
    return gltf_read_uv(uv, g, info);
}

/* A mesh has one stream of texture coordinates, those of the base colour or of the first map. Returns 0 if a map
 * needs others. */
static int same_uv(gltf_uv *uv, const gltf_uv *own)
{
    if (uv->set == JSON_NONE)
        *uv = *own;
    return uv->set == own->set && uv->moved == own->moved && memcmp(uv->m, own->m, sizeof own->m) == 0;
}

static int read_normal_map(lmb_material *out, gltf_uv *uv, gltf *g, uint32_t info)
{
    gltf_uv own;
    int32_t slot = -1;
    double scale = 1;
    if (!read_texture(&slot, &own, g, info, TEXELS_NORMALS) ||
        !json_read_double(&scale, &g->doc, json_member(&g->doc, info, "scale"), g->b->r))
        return 0;
    if (slot < 0)
        return 1;
    if (!same_uv(uv, &own)) {
        ++g->left_out.odd_normal_maps;
        return 1;
    }
    out->normal_map = (uint32_t)slot;
    out->normal_scale = scale > -1e6 && scale < 1e6 ? (float)scale : 0.0f;
    return 1;
}

#define LEAST_DIFFUSE 0.04 /* share of the colour of a metal, for drawing without a specular lobe */

static float clamp01(double v) { return v > 0 ? v < 1 ? (float)v : 1.0f : 0.0f; }

/* Means of the image that a texture info shows, from the texture made of it; computed once per image. */
static int texture_mean(const gltf_mean **out, gltf *g, uint32_t info, const lmb_texture *made)
{
    uint32_t texture, index;
    bitmap map;
    if (!gltf_item(&texture, g, &g->textures, json_member(&g->doc, info, "index")) ||
        !texture_image(&index, g, texture))
        return 0;
    gltf_mean *mean = &g->image_means[g->image_content[index]];
    if (!mean->known) {
        memset(&map, 0, sizeof map);
        map.texels = (uint8_t *)(uintptr_t)made->texels; /* only read */
        map.width = made->width;
        map.height = made->height;
        measure(mean, &map);
    }
    *out = mean;
    return 1;
}

/* Metalness and roughness of a material, both 0 .. 1, without the map. */
typedef struct gltf_metal {
    double metallic, rough;
    double mean;      /* of metallic, including the map */
    int32_t slot;     /* of the map for texels; -1: none */
} gltf_metal;

/* A map with other texture coordinates counts as its mean. A map that is not available counts as no metal, because
 * most surfaces are none. */
static int read_metal_map(gltf_metal *out, gltf_uv *uv, gltf *g, uint32_t map)
{
    const gltf_mean *mean;
    gltf_uv own;
    int32_t slot = -1;
    if (!read_texture(&slot, &own, g, map, TEXELS_NORMALS))
        return 0;
    g->left_out.metal_maps += out->metallic > 0;
    out->mean = 0;
    if (slot < 0) {
        out->metallic = 0;
        return 1;
    }
    if (!texture_mean(&mean, g, map, &g->b->textures[slot]))
        return 0;
    out->mean = out->metallic * mean->blue;
    if (same_uv(uv, &own)) {
        out->slot = slot;
    } else {
        out->metallic = out->mean;
        out->rough *= mean->green;
    }
    return 1;
}

static int read_metallic(gltf_metal *out, gltf_uv *uv, gltf *g, uint32_t pbr)
{
    const uint32_t map = json_member(&g->doc, pbr, "metallicRoughnessTexture");
    if (!json_read_double(&out->metallic, &g->doc, json_member(&g->doc, pbr, "metallicFactor"), g->b->r) ||
        !json_read_double(&out->rough, &g->doc, json_member(&g->doc, pbr, "roughnessFactor"), g->b->r))
        return 0;
    out->mean = out->metallic;
    if (map != JSON_NONE && !read_metal_map(out, uv, g, map))
        return 0;
    g->left_out.metals += out->mean >= 0.5;
    return 1;
}

/* The lobe beside albedo x (1 - metallic): 0.04 of a dielectric, the colour of a metal. Textured metals use the mean
 * colour, or texels if a map separates metal from dielectric. */
static void set_lobe(model_lobe *out, const double colour[3], const double base[3], double metallic, double rough)
{
    int k;
    metallic = (double)clamp01(metallic);
    for (k = 0; k < 3; ++k) {
        out->albedo[k] = clamp01(base[k] * (1 - metallic));
        out->specular[k] = clamp01(0.04 + (colour[k] - 0.04) * metallic);
    }
    out->roughness = clamp01(rough);
}

static int read_lobe(model_lobe *out, gltf *g, const lmb_material *m, const double base[3], const gltf_metal *metal,
                     uint32_t map)
{
    double colour[3] = {base[0], base[1], base[2]};
    const double metallic = metal->slot >= 0 ? 0 : metal->metallic;
    const gltf_mean *mean;
    int k;
    if (metal->slot >= 0) {
        out->metallic = clamp01(metal->metallic);
        out->metal_map = (uint32_t)metal->slot + 1;
    }
    if (m->texture >= 0 && metallic > 0) {
        if (!texture_mean(&mean, g, map, &g->b->textures[m->texture]))
            return 0;
        for (k = 0; k < 3; ++k)
            colour[k] *= mean->light[k];
    }
    set_lobe(out, colour, base, metallic, metal->rough);
    return 1;
}

static int read_alpha(lmb_material *out, gltf *g, uint32_t material)
{
    const uint32_t mode = json_member(&g->doc, material, "alphaMode");
    double cutoff = 0.5;
    if (mode == JSON_NONE || json_equals(&g->doc, mode, "OPAQUE"))
        return 1;
    if (json_equals(&g->doc, mode, "BLEND")) {
        ++g->left_out.blends;
        out->flags |= LMB_ALPHA_BLEND;
    } else if (!json_equals(&g->doc, mode, "MASK")) {
        return json_fail(&g->doc, mode, g->b->r, "must be OPAQUE, MASK or BLEND");
    } else if (!json_read_double(&cutoff, &g->doc, json_member(&g->doc, material, "alphaCutoff"), g->b->r)) {
        return 0;
    }
    out->flags |= LMB_ALPHA_MASK;
    out->alpha_cutoff = cutoff > 0 ? cutoff < 2 ? (float)cutoff : 2.0f : 0.0f;
    return 1;
}

/* Applies the map to the radiance: by texel; as a mean if it has other texture coordinates; not at all if
 * unavailable. */
static int read_emissive_map(lmb_material *out, double radiance[3], gltf_uv *uv, gltf *g, uint32_t map)
{
    const gltf_mean *mean;
    gltf_uv own;
    int32_t slot = -1;
    int k;
    if (!read_texture(&slot, &own, g, map, TEXELS_COLOUR))
        return 0;
    if (slot >= 0 && same_uv(uv, &own)) {
        out->emission_map = (uint32_t)slot + 1;
        return 1;
    }
    ++g->left_out.emissive_maps;
    if (slot >= 0 && !texture_mean(&mean, g, map, &g->b->textures[slot]))
        return 0;
    for (k = 0; k < 3; ++k)
        radiance[k] *= slot >= 0 ? mean->light[k] : 0;
    return 1;
}

/* Radiance: factor x KHR_materials_emissive_strength x the map. */
static int read_emission(lmb_material *out, gltf_uv *uv, gltf *g, uint32_t material)
{
    const json *doc = &g->doc;
    const uint32_t map = json_member(doc, material, "emissiveTexture"),
                   more = json_member(doc, json_member(doc, material, "extensions"), "KHR_materials_emissive_strength");
    double factor[3] = {0, 0, 0}, strength = 1;
    int k;
    if (!json_read_doubles(factor, 3, doc, json_member(doc, material, "emissiveFactor"), g->b->r) ||
        !json_read_double(&strength, doc, json_member(doc, more, "emissiveStrength"), g->b->r))
        return 0;
    if (map != JSON_NONE && (factor[0] > 0 || factor[1] > 0 || factor[2] > 0) &&
        !read_emissive_map(out, factor, uv, g, map))
        return 0;
    for (k = 0; k < 3; ++k) {
        factor[k] *= strength;
        out->emission[k] = factor[k] > 0 && factor[k] < 1e30 ? (float)factor[k] : 0.0f;
    }
    return 1;
}

/* Metals have no diffuse light. Without a lobe, 0.04 of the colour replaces it. If a map separates metal from
 * dielectric, the mean of the map is used: by texel the metal would be black, with nothing to show that it is metal. */
static int read_metal_rough(lmb_material *out, model_lobe *lobe, gltf_uv *uv, gltf *g, uint32_t pbr,
                            const double base[3])
{
    gltf_metal metal = {1, 1, 0, -1};
    if (!read_metallic(&metal, uv, g, pbr))
        return 0;
    const double diffuse = 1 - metal.mean > LEAST_DIFFUSE ? 1 - metal.mean : LEAST_DIFFUSE;
    for (int i = 0; i < 3; ++i)
        out->albedo[i] = clamp01(base[i] * diffuse);
    return read_lobe(lobe, g, out, base, &metal, json_member(&g->doc, pbr, "baseColorTexture"));
}

/* Multiplies specular colour and glossiness by the mean of the map. If the map cannot be read, the factors stay. */
static int read_specular_map(double specular[3], double *glossiness, gltf *g, uint32_t map)
{
    const gltf_mean *mean;
    gltf_uv own;
    int32_t slot = -1;
    if (!read_texture(&slot, &own, g, map, TEXELS_COLOUR))
        return 0;
    g->left_out.gloss_maps += map != JSON_NONE;
    if (slot < 0)
        return 1;
    if (!texture_mean(&mean, g, map, &g->b->textures[slot]))
        return 0;
    for (int k = 0; k < 3; ++k)
        specular[k] *= mean->light[k];
    *glossiness *= mean->alpha;
    return 1;
}

/* A metal without a lobe shows a share of the specular colour. The diffuse texture of a metal is black and must not
 * darken that. The texture is ignored if it shows no more than that share, unless it has alpha that cuts holes. */
static int leave_out_dark_texture(lmb_material *out, gltf *g, uint32_t texture, const double diffuse[3],
                                  const double dark[3])
{
    const gltf_mean *mean;
    if (out->texture < 0 || (out->flags & LMB_ALPHA_MASK) != 0)
        return 1;
    if (!texture_mean(&mean, g, texture, &g->b->textures[out->texture]))
        return 0;
    for (int k = 0; k < 3; ++k) {
        if (diffuse[k] * mean->light[k] > dark[k])
            return 1;
    }
    out->texture = -1;
    return 1;
}

/* KHR_materials_pbrSpecularGlossiness: the diffuse colour is scaled by 1 - the highest specular channel. F0 is the
 * specular colour, and alpha is (1 - glossiness)^2. */
static int read_specular_glossiness(lmb_material *out, model_lobe *lobe, gltf *g, uint32_t other, const double base[3])
{
    const json *doc = &g->doc;
    double specular[3] = {1, 1, 1}, glossiness = 1, peak, diffuse[3], dark[3];
    if (!json_read_doubles(specular, 3, doc, json_member(doc, other, "specularFactor"), g->b->r) ||
        !json_read_double(&glossiness, doc, json_member(doc, other, "glossinessFactor"), g->b->r) ||
        !read_specular_map(specular, &glossiness, g, json_member(doc, other, "specularGlossinessTexture")))
        return 0;
    peak = (double)clamp01(fmax(specular[0], fmax(specular[1], specular[2])));
    for (int k = 0; k < 3; ++k) {
        diffuse[k] = base[k] * (1 - peak);
        dark[k] = LEAST_DIFFUSE * specular[k];
        lobe->albedo[k] = clamp01(diffuse[k]);
        lobe->specular[k] = clamp01(specular[k]);
        out->albedo[k] = clamp01(diffuse[k] > dark[k] ? diffuse[k] : dark[k]);
    }
    lobe->roughness = clamp01(1 - glossiness);
    g->left_out.metals += peak >= 0.5;
    return peak < 0.5 || leave_out_dark_texture(out, g, json_member(doc, other, "diffuseTexture"), diffuse, dark);
}

/* Uses the base colour unchanged. */
static void set_unlit(lmb_material *out, model_lobe *lobe, gltf *g, const double base[3])
{
    for (int k = 0; k < 3; ++k)
        lobe->albedo[k] = out->albedo[k] = clamp01(base[k]);
    out->flags |= LMB_UNLIT;
    ++g->left_out.unlit;
}

static int read_material(lmb_material *out, model_lobe *lobe, gltf_uv *uv, gltf *g, uint32_t material)
{
    const json *doc = &g->doc;
    const uint32_t pbr = json_member(doc, material, "pbrMetallicRoughness"),
                   more = json_member(doc, material, "extensions"),
                   other = pbr == JSON_NONE ? json_member(doc, more, "KHR_materials_pbrSpecularGlossiness") : JSON_NONE;
    const int unlit = json_member(doc, more, "KHR_materials_unlit") != JSON_NONE;
    const uint32_t factor = other != JSON_NONE ? json_member(doc, other, "diffuseFactor")
                                               : json_member(doc, pbr, "baseColorFactor"),
                   texture = other != JSON_NONE ? json_member(doc, other, "diffuseTexture")
                                                : json_member(doc, pbr, "baseColorTexture");
    double base[4] = {1, 1, 1, 1};
    int sided = 0;
    if (!json_read_doubles(base, 4, doc, factor, g->b->r) ||
        !json_read_bool(&sided, doc, json_member(doc, material, "doubleSided"), g->b->r) ||
        !read_alpha(out, g, material) || !read_texture(&out->texture, uv, g, texture, TEXELS_COLOUR))
        return 0;
    out->alpha = clamp01(base[3]);
    out->flags |= sided ? LMB_DOUBLE_SIDED : 0;
    if (unlit) {
        set_unlit(out, lobe, g, base);
        return 1;
    }
    return read_normal_map(out, uv, g, json_member(doc, material, "normalTexture")) &&
           (other != JSON_NONE ? read_specular_glossiness(out, lobe, g, other, base)
                               : read_metal_rough(out, lobe, uv, g, pbr, base)) &&
           read_emission(out, uv, g, material);
}

static void plain_material(lmb_material *out)
{
    memset(out, 0, sizeof *out);
    out->albedo[0] = out->albedo[1] = out->albedo[2] = out->alpha = 1.0f;
    out->alpha_cutoff = 0.5f;
    out->texture = -1;
}

/* Allocates tables by texture and image before any is read. */
static int make_tables(gltf *g)
{
    uint32_t i, k;
    for (k = 0; k < 2; ++k) {
        g->slots[k] = (int32_t *)build_scratch(g->b, g->textures.count, sizeof *g->slots[k]);
        g->image_texels[k] = (lmb_texture *)build_scratch(g->b, g->images.count, sizeof *g->image_texels[k]);
        if (!g->slots[k] || !g->image_texels[k])
            return 0;
        for (i = 0; i < g->textures.count; ++i)
            g->slots[k][i] = SLOT_UNKNOWN;
    }
    g->image_content = (uint32_t *)build_scratch(g->b, g->images.count, sizeof *g->image_content);
    g->image_means = (gltf_mean *)build_scratch(g->b, g->images.count, sizeof *g->image_means);
    g->b->textures = (lmb_texture *)build_keep(g->b, 2 * (uint64_t)g->textures.count, sizeof *g->b->textures);
    return g->image_content && g->image_means && g->b->textures;
}

int gltf_materials(gltf *g)
{
    const uint32_t n = g->materials.count;
    uint32_t i;
    g->b->out->lobes = (model_lobe *)build_keep(g->b, (uint64_t)n + 1, sizeof *g->b->out->lobes);
    g->material_uv = (gltf_uv *)build_scratch(g->b, (uint64_t)n + 1, sizeof *g->material_uv);
    if (!build_materials(g->b, (uint64_t)n + 1) || !g->material_uv || !g->b->out->lobes || !make_tables(g))
        return 0;
    for (i = 0; i < n; ++i) {
        plain_material(&g->b->materials[i]);
        if (!read_material(&g->b->materials[i], &g->b->out->lobes[i], &g->material_uv[i], g, g->materials.items[i]))
            return 0;
    }
    g->b->material_count = n;
    g->default_material = JSON_NONE;
    return 1;
}

/* The default in glTF is a metal, which would be nearly black here. White without a lobe is better for files without
 * materials. */
void gltf_default_material(gltf *g)
{
    int k;
    if (g->default_material != JSON_NONE)
        return;
    g->default_material = g->b->material_count++;
    plain_material(&g->b->materials[g->default_material]);
    for (k = 0; k < 3; ++k)
        g->b->out->lobes[g->default_material].albedo[k] = 1.0f;
    g->material_uv[g->default_material].set = JSON_NONE;
}

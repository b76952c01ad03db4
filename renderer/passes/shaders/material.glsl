// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// The material at a point of the surface, and its light. BEAMS (how many), COLOR_MAP, NORMAL_MAP, ROUGHNESS_MAP,
// SPECULAR_MAP and SPECULAR (whether there is any) are defined by the program.
#include "surface.glsl"

layout(binding = 0) uniform sampler2D base_color_map; // decoded to linear Rec. 709 by its sRGB format
layout(binding = 1) uniform sampler2D normal_map;
layout(binding = 2) uniform sampler2D roughness_map;
layout(binding = 3) uniform sampler2DArray shadow_maps; // depth from each light, 0 to 1
layout(binding = 4) uniform sampler2D specular_albedo_table; // x: cosine, y: slope m
layout(binding = 5) uniform sampler2DArray shadow_bounds; // least and greatest depth around each block of texels
layout(binding = 7) uniform sampler2D specular_map; // strength of the reflection in alpha

uniform vec3 base_color_factor;
uniform float normal_scale;
uniform float roughness_factor; // glTF's perceptual roughness
uniform float specular_factor;
uniform bool double_sided;

uniform vec3 ambient_irradiance;
#if BEAMS > 0
uniform vec3 light_direction[BEAMS]; // unit, towards the light
uniform vec3 light_irradiance[BEAMS];
uniform mat4 light_from_world[BEAMS];
uniform float shadow_texel_mm[BEAMS];
uniform float shadow_sigma_texels[BEAMS];
uniform int shadow_layer[BEAMS];
#endif
uniform float widest_shadow_sigma; // texels
uniform float slant_lift; // lift per length by which a pixel's square is drawn out: 0 in texture space
uniform int shadow_block; // texels of the map a side of one texel of shadow_bounds
uniform float texture_mix;
uniform float specular_intensity;

const float pi = 3.14159265358979;
const int table_size = 64; // specular_albedo_table is table_size squared

// The unit vector along v; zero, which no light reaches, where v has no direction.
vec3 direction_of(vec3 v) {
    float vv = dot(v, v);
    return vv > 1e-12 ? v * inversesqrt(vv) : vec3(0.0);
}

vec3 albedo() {
#if COLOR_MAP
    return base_color_factor * surface_texture(base_color_map).rgb;
#else
    return base_color_factor;
#endif
}

// The part of the colour that an exponent of it stands for; 0 to the power 0 is 1 here, but undefined in GLSL.
vec3 part_of_color(vec3 color, float exponent) { return exponent > 0.0 ? pow(color, vec3(exponent)) : vec3(1.0); }

// Beckmann's slope m: the square of the perceptual roughness, as glTF's alpha is.
float slope() {
    float roughness = roughness_factor;
#if ROUGHNESS_MAP
    roughness *= surface_texture(roughness_map).g;
#endif
    return max(roughness * roughness, 0.02);
}

// What the reflection is multiplied with: the look's intensity times the material's.
float specular_strength() {
    float strength = specular_intensity * specular_factor;
#if SPECULAR_MAP
    strength *= surface_texture(specular_map).a;
#endif
    return strength;
}

vec3 geometric_normal() {
    vec3 N = direction_of(surface_normal());
    return double_sided && !gl_FrontFacing ? -N : N;
}

vec3 mapped_normal() {
    vec3 N = geometric_normal();
#if !NORMAL_MAP
    return direction_of(N);
#else
    vec3 T = direction_of(surface_tangent().xyz - N * dot(N, surface_tangent().xyz));
    vec3 B = cross(N, T) * surface_tangent().w;
    vec3 n = surface_texture(normal_map).xyz * 2.0 - 1.0;
    return direction_of((T * n.x + B * n.y) * normal_scale + N * n.z); // green and bitangent both point up the image
#endif
}

// rho_dt of [DEonLuebke2007]: what is reflected specularly from direction with cosine NoX.
float specular_albedo(float NoX, float m) {
#if !SPECULAR
    return 0.0; // its factor is 0
#endif
    vec2 place = vec2(clamp(NoX, 0.0, 1.0) * float(table_size - 1) + 0.5, m * float(table_size) - 0.5);
    return texture(specular_albedo_table, place / float(table_size)).r;
}

// Weights of shadow map's texels at distances (texels) from the point: a Gaussian that ends smoothly at the reach.
vec4 shadow_weights(vec4 distance, float sigma, float reach) {
    float inverse_variance = 1.0 / max(sigma * sigma, 0.05);
    float end = reach + 1.0;
    vec4 weights = exp(-0.5 * inverse_variance * distance * distance) - exp(-0.5 * inverse_variance * end * end);
    return max(weights, vec4(0.0));
}

// Share of the light that reaches the surface: percentage-closer filtering [Reeves1987] with Gaussian weights, four
// texels at a time. Each texel is compared with the depth that the surface's own plane has there, so that the filter
// needs no bias that grows with its reach. The filter is at least as wide as the square that the pixel covers, of which
// the shader sees one point; and the plane is lifted by two texels, and more where the surface is seen from the side, since
// there the point may lie that far beside its triangle. It is lifted towards the light: to move it sideways would move the
// shadows.
#if BEAMS > 0
float visibility(int k) {
    vec3 N = geometric_normal();
    vec2 pixel_mm = vec2(length(dFdx(surface_position_mm())), length(dFdy(surface_position_mm())));
    float slant_mm = abs(pixel_mm.x - pixel_mm.y);
    vec3 place = (light_from_world[k] * vec4(surface_position_mm(), 1.0)).xyz * 0.5 + 0.5;
    vec2 size = vec2(textureSize(shadow_maps, 0).xy);
    vec2 along_x = dFdx(place.xy) * size;
    vec2 along_y = dFdy(place.xy) * size;
    float pixel_variance = (dot(along_x, along_x) + dot(along_y, along_y)) / 24.0;
    float sigma = min(sqrt(shadow_sigma_texels[k] * shadow_sigma_texels[k] + pixel_variance), widest_shadow_sigma);
    float reach = ceil(2.0 * sigma);
    float NoL = dot(N, light_direction[k]);
    if (NoL <= 0.0) {
        return 0.0;
    }
    if (any(lessThan(place, vec3(0.0))) || any(greaterThanEqual(place, vec3(1.0)))) {
        return 1.0; // out of the box around the model, where nothing casts shadows
    }
    // The plane in the map: depth per texel along x and y. Planes that the light grazes are taken as if it did so less.
    mat3 rows = transpose(mat3(light_from_world[k]));
    vec3 n = vec3(dot(rows[0], N), dot(rows[1], N), dot(rows[2], N)) /
             vec3(dot(rows[0], rows[0]), dot(rows[1], rows[1]), dot(rows[2], rows[2]));
    float depth_per_mm = 0.5 * length(rows[2]);
    vec2 slope = -n.xy / (min(n.z, -0.05 / (2.0 * depth_per_mm)) * size);
    place.z -= depth_per_mm * (2.0 * shadow_texel_mm[k] + slant_lift * slant_mm) / max(NoL, 0.05);

    // All that the filter meets lies behind the plane, or all before it: then no tap is needed.
    float rise = (abs(slope.x) + abs(slope.y)) * (reach + 1.0);
    vec2 bounds = texelFetch(shadow_bounds, ivec3(ivec2(place.xy * size) / shadow_block, shadow_layer[k]), 0).xy;
    if (place.z + rise <= bounds.x || place.z - rise > bounds.y) {
        return place.z + rise <= bounds.x ? 1.0 : 0.0;
    }
    vec2 point = place.xy * size - 0.5; // texel centres at whole numbers
    vec2 first = floor(point) - reach;
    float lit = 0.0;
    float total = 0.0;
    for (float y = 0.0; y <= 2.0 * reach; y += 2.0) {
        for (float x = 0.0; x <= 2.0 * reach; x += 2.0) {
            vec2 texel = first + vec2(x, y);
            vec4 depth = textureGather(shadow_maps, vec3((texel + 1.0) / size, shadow_layer[k]));
            // Gathered in the order (0, 1), (1, 1), (1, 0), (0, 0).
            vec4 dx = texel.x - point.x + vec4(0.0, 1.0, 1.0, 0.0);
            vec4 dy = texel.y - point.y + vec4(1.0, 1.0, 0.0, 0.0);
            vec4 weight = shadow_weights(dx, sigma, reach) * shadow_weights(dy, sigma, reach);
            // Beside the model nothing casts shadows, though the plane may go on beyond the map's greatest depth there.
            lit += dot(weight, step(min(place.z + slope.x * dx + slope.y * dy, 1.0), depth));
            total += dot(weight, vec4(1.0));
        }
    }
    return lit / total;
}

// Light of one beam that gets into the surface.
vec3 entering_beam(int k, vec3 N, float m, float strength, float visible) {
    float NoL = dot(N, light_direction[k]);
    return light_irradiance[k] * (max(NoL, 0.0) * visible * (1.0 - strength * specular_albedo(NoL, m)));
}
#endif

vec3 entering_ambient(vec3 N) { return ambient_irradiance * (0.5 + 0.5 * N.y); }

// Light that enters the skin, with the part of the colour that is applied before scattering, as the radiance it would
// leave with: E albedo^mix / pi.
vec3 entering_radiance(vec3 irradiance, vec3 color) { return irradiance * part_of_color(color, texture_mix) / pi; }

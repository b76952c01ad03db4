// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// The material at a point of the surface, and its light. Needs the Surface block.
in Surface {
    centroid vec3 position_mm;
    centroid vec3 normal;
    centroid vec4 tangent;
    centroid vec2 uv;
    centroid float depth_mm;
} surface;

layout(binding = 0) uniform sampler2D base_color_map; // decoded to linear Rec. 709 by its sRGB format
layout(binding = 1) uniform sampler2D normal_map;
layout(binding = 2) uniform sampler2D roughness_map;
layout(binding = 3) uniform sampler2DShadow shadow_map;
layout(binding = 4) uniform sampler2D specular_albedo_table; // x: cosine, y: slope m
layout(binding = 5) uniform sampler2D shadow_bounds; // least and greatest depth within the filter's reach

uniform vec3 base_color_factor;
uniform float normal_scale;
uniform float roughness_factor; // glTF's perceptual roughness
uniform bool double_sided;

uniform vec3 light_direction; // unit, towards the light
uniform vec3 light_irradiance;
uniform vec3 ambient_irradiance;
uniform mat4 light_from_world;
uniform float shadow_texel_mm;
uniform float shadow_sigma_texels;
uniform int shadow_reach; // texels to each side of the filter's middle
uniform float texture_mix;
uniform float specular_intensity;

const float pi = 3.14159265358979;
const int table_size = 64; // specular_albedo_table is table_size squared

// Kept off 0, whose power 0 is undefined.
vec3 albedo() { return max(base_color_factor * texture(base_color_map, surface.uv).rgb, vec3(1e-6)); }

// Beckmann's slope m: the square of the perceptual roughness, as glTF's alpha is.
float slope() {
    float roughness = roughness_factor * texture(roughness_map, surface.uv).g;
    return max(roughness * roughness, 0.02);
}

vec3 geometric_normal() {
    vec3 N = normalize(surface.normal);
    return double_sided && !gl_FrontFacing ? -N : N;
}

vec3 mapped_normal() {
    vec3 N = geometric_normal();
    vec3 T = normalize(surface.tangent.xyz - N * dot(N, surface.tangent.xyz));
    vec3 B = cross(N, T) * surface.tangent.w;
    vec3 n = texture(normal_map, surface.uv).xyz * 2.0 - 1.0;
    return normalize((T * n.x + B * n.y) * normal_scale + N * n.z); // green and bitangent both point up the image
}

// rho_dt of [DEonLuebke2007]: what is reflected specularly from direction with cosine NoX.
float specular_albedo(float NoX, float m) {
    vec2 place = vec2(clamp(NoX, 0.0, 1.0) * float(table_size - 1) + 0.5, m * float(table_size) - 0.5);
    return texture(specular_albedo_table, place / float(table_size)).r;
}

// Weight of a shadow map's texel at a distance (texels) from the point: a Gaussian that ends smoothly at the reach.
vec4 shadow_weights(vec4 distance) {
    float inverse_variance = 1.0 / max(shadow_sigma_texels * shadow_sigma_texels, 0.05);
    float end = float(shadow_reach) + 1.0;
    vec4 weights = exp(-0.5 * inverse_variance * distance * distance) - exp(-0.5 * inverse_variance * end * end);
    return max(weights, vec4(0.0));
}

// Share of the light that reaches the surface: percentage-closer filtering [Reeves1987] with Gaussian weights,
// four texels at a time.
float visibility() {
    vec3 N = geometric_normal();
    float NoL = dot(N, light_direction);
    // Lift the point off the surface by what the filter reaches over a plane of this tilt, so that it does not
    // shadow itself.
    float tilt = sqrt(max(1.0 - NoL * NoL, 0.0));
    float lift_mm = shadow_texel_mm * (float(shadow_reach + 1) * tilt + 0.5);
    vec3 place = (light_from_world * vec4(surface.position_mm + N * lift_mm, 1.0)).xyz * 0.5 + 0.5;
    if (any(lessThan(place, vec3(0.0))) || any(greaterThanEqual(place, vec3(1.0)))) {
        return 1.0; // lifted out of the box around the model, where nothing casts shadows
    }
    // All that the filter meets lies behind the point, or all before it: then no tap is needed.
    vec2 size = vec2(textureSize(shadow_map, 0));
    vec2 bounds = texelFetch(shadow_bounds, ivec2(place.xy * size), 0).xy;
    if (place.z <= bounds.x || place.z > bounds.y) {
        return place.z <= bounds.x ? 1.0 : 0.0;
    }
    vec2 point = place.xy * size - 0.5; // texel centres at whole numbers
    vec2 first = floor(point) - float(shadow_reach);
    float lit = 0.0;
    float total = 0.0;
    for (int y = 0; y <= 2 * shadow_reach; y += 2) {
        for (int x = 0; x <= 2 * shadow_reach; x += 2) {
            vec2 texel = first + vec2(x, y);
            vec4 near = textureGather(shadow_map, (texel + 1.0) / size, place.z);
            vec2 d = texel - point;
            // Gathered in the order (0, 1), (1, 1), (1, 0), (0, 0).
            vec4 along_x = shadow_weights(d.x + vec4(0.0, 1.0, 1.0, 0.0));
            vec4 along_y = shadow_weights(d.y + vec4(1.0, 1.0, 0.0, 0.0));
            lit += dot(along_x * along_y, near);
            total += dot(along_x, along_y);
        }
    }
    return lit / total;
}

// Light that enters the skin at this point, with the part of the colour that is applied before scattering,
// as the radiance it would leave with: E albedo^mix / pi.
vec3 entering_light(vec3 N, vec3 color, float m, float visible) {
    float NoL = dot(N, light_direction);
    vec3 direct = light_irradiance * (max(NoL, 0.0) * visible * (1.0 - specular_intensity * specular_albedo(NoL, m)));
    vec3 ambient = ambient_irradiance * (0.5 + 0.5 * N.y);
    return (direct + ambient) * pow(color, vec3(texture_mix)) / pi;
}

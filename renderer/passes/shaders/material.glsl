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
uniform float texture_mix;
uniform float specular_intensity;

const float pi = 3.14159265358979;
const int table_size = 64; // specular_albedo_table is table_size squared

vec3 albedo() { return base_color_factor * texture(base_color_map, surface.uv).rgb; }

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
    // Green points up the image (glTF); the bitangent runs along +v, down the image.
    return normalize(T * n.x * normal_scale - B * n.y * normal_scale + N * n.z);
}

// rho_dt of [DEonLuebke2007, section 14.3.2]: what is reflected specularly from direction with cosine NoX.
float specular_albedo(float NoX, float m) {
    vec2 place = vec2(clamp(NoX, 0.0, 1.0) * float(table_size - 1) + 0.5, m * float(table_size) - 0.5);
    return texture(specular_albedo_table, place / float(table_size)).r;
}

// Share of the light that reaches the surface: percentage-closer filtering (Reeves et al. 1987) with Gaussian weights
// on the shadow map's texels, each tap interpolated by the sampler.
float visibility() {
    vec3 N = geometric_normal();
    float NoL = dot(N, light_direction);
    float reach = ceil(2.0 * shadow_sigma_texels);
    // Lift the point off the surface by what the filter reaches over a plane of this tilt, so that it does not
    // shadow itself.
    float lift_mm = shadow_texel_mm * (reach + 1.0) * sqrt(max(1.0 - NoL * NoL, 0.0)) + 0.5 * shadow_texel_mm;
    vec3 place = (light_from_world * vec4(surface.position_mm + N * lift_mm, 1.0)).xyz * 0.5 + 0.5;
    if (place.z >= 1.0) {
        return 1.0;
    }
    float lit = 0.0;
    float total = 0.0;
    vec2 texel = 1.0 / vec2(textureSize(shadow_map, 0));
    for (float y = -reach; y <= reach; ++y) {
        for (float x = -reach; x <= reach; ++x) {
            float weight = exp(-0.5 * (x * x + y * y) / max(shadow_sigma_texels * shadow_sigma_texels, 1e-4));
            lit += weight * texture(shadow_map, vec3(place.xy + vec2(x, y) * texel, place.z));
            total += weight;
        }
    }
    return lit / total;
}

// Light that enters the skin at this point, with the part of the colour that is applied before scattering,
// as the radiance it would leave with: E albedo^mix / pi.
vec3 entering_light(vec3 N, float m, float visible) {
    float NoL = dot(N, light_direction);
    vec3 direct = light_irradiance * (max(NoL, 0.0) * visible * (1.0 - specular_intensity * specular_albedo(NoL, m)));
    vec3 ambient = ambient_irradiance * (0.5 + 0.5 * N.y);
    return (direct + ambient) * pow(albedo(), vec3(texture_mix)) / pi;
}

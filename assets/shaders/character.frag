// glTF metallic-roughness materials. Textures that a material lacks are compiled out: on a software rasteriser every
// fetch counts.
#include "frame.glsl"
#include "lighting.glsl"

in vec3 worldPosition;
in vec3 worldNormal;
in vec4 worldTangent;
in vec2 textureUv;
#ifdef VERTEX_COLORS
in vec4 vertexColor;
#endif
flat in vec4 tint;
in vec4 highlight;

uniform vec4 baseColor;
uniform vec3 emissive;
uniform float metallic;
uniform float roughness;
uniform float alphaCutoff;
uniform float blended;  // 1 in the translucent pass, else 0

uniform sampler2D baseColorTexture;
uniform sampler2D metallicRoughnessTexture;
uniform sampler2D normalTexture;
uniform sampler2D occlusionTexture;
uniform sampler2D emissiveTexture;

out vec4 fragment;

vec3 shadingNormal(vec3 geometric) {
#ifdef NORMAL_TEXTURE
    vec3 mapped = texture(normalTexture, textureUv).xyz * 2.0 - 1.0;
    vec3 tangent = worldTangent.xyz - geometric * dot(worldTangent.xyz, geometric);
    float size = dot(tangent, tangent);
    if (size < 1e-8) return geometric;
    tangent *= inversesqrt(size);
    vec3 bitangent = cross(geometric, tangent) * worldTangent.w;
    // Compressed or blank maps can hold a zero vector.
    return normalize(tangent * mapped.x + bitangent * mapped.y + geometric * max(mapped.z, 1e-3));
#else
    return geometric;
#endif
}

void main() {
    vec4 color = baseColor;
#ifdef BASE_TEXTURE
    color *= texture(baseColorTexture, textureUv);
#endif
#ifdef VERTEX_COLORS
    color *= vertexColor;
#endif
    color *= tint;
#ifdef ALPHA_MASK
    if (color.a < alphaCutoff * tint.a) discard;
    color.a = tint.a;
#endif
    Surface surface;
    surface.position = worldPosition;
    surface.geometric = normalize(worldNormal);
    if (!gl_FrontFacing) surface.geometric = -surface.geometric;
    surface.normal = shadingNormal(surface.geometric);
    surface.albedo = color.rgb;
    surface.metallic = metallic;
    surface.roughness = roughness;
    surface.occlusion = 1.0;
    surface.emissive = emissive;
#ifdef METALLIC_ROUGHNESS_TEXTURE
    vec4 sampled = texture(metallicRoughnessTexture, textureUv);
    surface.roughness *= sampled.g;
    surface.metallic *= sampled.b;
#endif
#ifdef OCCLUSION_TEXTURE
    surface.occlusion = texture(occlusionTexture, textureUv).r;
#endif
#ifdef EMISSIVE_TEXTURE
    surface.emissive *= texture(emissiveTexture, textureUv).rgb;
#endif
    vec3 display = toneMap(shade(surface));
    float rim = 1.0 - clamp(dot(surface.normal, towardsEye(worldPosition)), 0.0, 1.0);
    display = mix(display, highlight.rgb, highlight.a * (0.45 + 0.55 * rim * rim));
    fragment = vec4(display, mix(1.0, color.a, blended));
}

// Metallic-roughness shading (glTF 2.0, appendix B) under the sun, the local lights and the sky. Compiled in variants, as
// even a loop that runs zero times costs a software rasteriser its first turn:
//   LOCAL_LIGHTS  there are some    UNSHADOWED  the sun casts no shadow    UNOCCLUDED  no ambient occlusion
//   FAST  fewer taps of the shadow    ENVIRONMENT_MAP  a panorama in place of the procedural sky
#include "noise.glsl"
#include "tone_map.glsl"
#ifdef ENVIRONMENT_MAP
#include "panorama.glsl"
uniform sampler2D environmentMap;
#endif

uniform sampler2DShadow shadowMap;
uniform sampler2D shadowDepth;  // the same map, uncompared
uniform sampler2D occlusionMap;

const float kPi = 3.14159265;

struct Surface {
    vec3 position;  // world
    vec3 normal;    // world, unit, towards the eye's side
    vec3 geometric; // the same before normal mapping, for the shadow's offset
    vec3 albedo;    // linear
    float metallic;
    float roughness;
    float occlusion;
    vec3 emissive;
};

#ifdef ENVIRONMENT_MAP
vec3 skyRadiance(vec3 direction, float roughness) {
    return textureLod(environmentMap, panoramaUv(direction), roughness * environment.y).rgb * environment.x;
}

vec3 skyIrradiance(vec3 n) {
    vec3 sum = environmentDiffuse[0].rgb + environmentDiffuse[1].rgb * n.y + environmentDiffuse[2].rgb * n.z;
    sum += environmentDiffuse[3].rgb * n.x + environmentDiffuse[4].rgb * (n.x * n.y);
    sum += environmentDiffuse[5].rgb * (n.y * n.z) + environmentDiffuse[6].rgb * (3.0 * n.z * n.z - 1.0);
    sum += environmentDiffuse[7].rgb * (n.x * n.z) + environmentDiffuse[8].rgb * (n.x * n.x - n.y * n.y);
    return max(sum, 0.0) * environment.x;
}
#else
// Radiance of the sky, blurred by roughness in [0, 1]; a broad glow stands around the sun.
vec3 skyRadiance(vec3 direction, float roughness) {
    float blur = mix(0.06, 0.9, roughness);
    float above = smoothstep(-blur, blur, direction.y);
    float height = clamp(direction.y, 0.0, 1.0);
    vec3 sky = mix(skyHorizon.rgb, skyZenith.rgb, sqrt(height) * (1.0 - 0.4 * roughness));
    float glow = pow(max(dot(direction, sunDirection.xyz), 0.0), mix(24.0, 3.0, roughness));
    sky += skyHorizon.rgb * glow * mix(1.2, 0.35, roughness);
    return mix(skyGround.rgb, sky, above);
}

// What arrives from the whole hemisphere around a normal.
vec3 skyIrradiance(vec3 normal) {
    vec3 sky = mix(skyHorizon.rgb, skyZenith.rgb, 0.5);
    float sun = max(dot(normal, sunDirection.xyz), 0.0);
    return mix(skyGround.rgb, sky, 0.5 + 0.5 * normal.y) + skyHorizon.rgb * (0.16 * sun);
}

#endif

// Turns by the golden angle: points at the radii sqrt((i + 0.5) / n) spread evenly over a disc (Vogel's spiral).
const mat2 kGoldenTurn = mat2(-0.73736888, -0.67549029, 0.67549029, -0.73736888);

#ifdef UNSHADOWED
float sunVisibility(vec3 position, vec3 normal) {
    return 1.0;
}
#else

#ifdef FAST
// For software rasterisers: a narrow filter of four taps, each blended by the sampler.
float filteredShadow(vec3 at, float slope) {
    float reach = 0.75 * shadowTexel.y;
    float reference = at.z - slope * reach;
    float lit = textureLod(shadowMap, vec3(at.xy + reach * vec2(1.0, 0.3), reference), 0.0);
    lit += textureLod(shadowMap, vec3(at.xy + reach * vec2(-0.3, 1.0), reference), 0.0);
    lit += textureLod(shadowMap, vec3(at.xy + reach * vec2(-1.0, -0.3), reference), 0.0);
    lit += textureLod(shadowMap, vec3(at.xy + reach * vec2(0.3, -1.0), reference), 0.0);
    return 0.25 * lit;
}
#else
// A penumbra that widens with the distance from what casts the shadow (percentage-closer soft shadows: Fernando 2005).
//
// The loops have bounds that depend on the pixel: a software rasteriser runs both sides of an if, but it does leave a
// loop when no pixel of its group needs it any more.
float filteredShadow(vec3 at, float slope) {
    const int kBlockerTaps = 8;
    const int kTaps = 12;
    float turn = 6.2831853 * pixelNoise();
    vec2 start = vec2(cos(turn), sin(turn));
    vec2 direction = start;
    float search = 0.8 * shadowTexel.w;
    float above = 0.0;
    float blockers = 0.0;
    int blockerTaps = slope < 0.0 ? 0 : kBlockerTaps;
    for (int tap = 0; tap < blockerTaps; ++tap) {
        float reach = search * sqrt((float(tap) + 0.5) / float(kBlockerTaps));
        float gap = at.z - slope * reach - textureLod(shadowDepth, at.xy + direction * reach, 0.0).r;
        direction = kGoldenTurn * direction;
        float blocks = step(0.0, gap);
        above += gap * blocks;
        blockers += blocks;
    }
    // shadowTexel.z: penumbra in map units for a gap over the whole depth of the map.
    float radius = clamp(above / max(blockers, 1.0) * shadowTexel.z, 1.2 * shadowTexel.y, shadowTexel.w);
    // Where no blocker was met, one may still touch the very point: a few narrow taps.
    int taps = blockerTaps == 0 ? 0 : (blockers > 0.0 ? kTaps : 3);
    float lit = 0.0;
    direction = start;
    // By far less than the gap that made the filter so wide.
    float reference = at.z - slope * radius;
    for (int tap = 0; tap < taps; ++tap) {
        vec2 offset = direction * (radius * sqrt((float(tap) + 0.5) / float(kTaps)));
        direction = kGoldenTurn * direction;
        lit += textureLod(shadowMap, vec3(at.xy + offset, reference), 0.0);
    }
    return taps > 0 ? lit / float(taps) : 1.0;
}
#endif

// Share of the sun that arrives, [0, 1]. The point is moved along its normal by about a texel, so that a surface does
// not shade itself (normal offset: Holbert 2011), more where the light grazes.
float sunVisibility(vec3 position, vec3 normal) {
    float cosine = clamp(dot(normal, sunDirection.xyz), 0.0, 1.0);
    float grazing = sqrt(1.0 - cosine * cosine);
    vec3 moved = position + normal * (shadowTexel.x * (1.0 + 3.0 * grazing));
    vec3 at = (shadowFromWorld * vec4(moved, 1.0)).xyz;
    bool inside = all(greaterThan(at.xy, vec2(0.0))) && all(lessThan(at, vec3(1.0)));
    bool asked = inside && cosine > 0.0;
    // How much nearer the surface itself comes to the light within the filter, in the map's depth; negative where the
    // map has no say.
    float slope = asked ? sunColor.w * min(grazing / max(cosine, 1e-3), 3.0) : -1.0;
    // Towards the map's border it fades, so that no edge shows where the map ends inside the picture.
    vec2 fromMiddle = abs(at.xy * 2.0 - 1.0);
    float fade = smoothstep(0.9, 1.0, max(fromMiddle.x, fromMiddle.y));
    return asked ? mix(filteredShadow(at, slope), 1.0, fade) : 1.0;
}
#endif

// Share of the sky that nearby geometry leaves open at this pixel.
float ambientVisibility() {
#ifdef UNOCCLUDED
    return 1.0;
#endif
    return target.w > 0.5 ? texture(occlusionMap, gl_FragCoord.xy * viewport.zw).r : 1.0;
}

// Specular reflectance of one light: GGX distribution with the height-correlated Smith term of Hammon (2017), Schlick's
// Fresnel. The factor pi is left out, as light intensities are irradiance / pi.
vec3 specularLobe(vec3 f0, float roughness, vec3 normal, vec3 toEye, vec3 toLight) {
    vec3 middle = normalize(toEye + toLight);
    float alpha = max(roughness * roughness, 0.02);
    float nh = max(dot(normal, middle), 0.0);
    float nl = max(dot(normal, toLight), 1e-3);
    float nv = max(dot(normal, toEye), 1e-3);
    float d = nh * nh * (alpha * alpha - 1.0) + 1.0;
    float distribution = alpha * alpha / (d * d);
    float visibility = 0.5 / mix(2.0 * nl * nv, nl + nv, alpha);
    float grazing = 1.0 - max(dot(toEye, middle), 0.0);
    float grazing2 = grazing * grazing;
    vec3 fresnel = f0 + (1.0 - f0) * (grazing2 * grazing2 * grazing);
    return fresnel * (distribution * visibility);
}

// Reflectance of a hemisphere of even light (fit of Karis 2014).
vec3 environmentReflectance(vec3 f0, float roughness, float nv) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 scaleBias = vec2(-1.04, 1.04) * a + r.zw;
    return f0 * scaleBias.x + scaleBias.y;
}

// One local light's colour at a point, with its fall-off; `toLight` gets the unit direction.
vec3 localLightAt(LocalLight light, vec3 position, out vec3 toLight) {
    vec3 offset = light.positionRange.xyz - position;
    float squared = max(dot(offset, offset), 1e-4);
    toLight = offset * inversesqrt(squared);
    float ratio = squared / (light.positionRange.w * light.positionRange.w);
    float window = clamp(1.0 - ratio * ratio, 0.0, 1.0);
    float cosine = -dot(toLight, light.directionCosine.xyz);
    float cone = smoothstep(light.directionCosine.w - 1e-3, light.colorCosine.w, cosine);
    return light.colorCosine.rgb * (window * window * cone / squared);
}

// Radiance that leaves a surface towards the eye.
vec3 shade(Surface surface) {
    vec3 toEye = towardsEye(surface.position);
    vec3 f0 = mix(vec3(0.04), surface.albedo, surface.metallic);
    vec3 diffuse = surface.albedo * (1.0 - surface.metallic);
    float nv = clamp(dot(surface.normal, toEye), 0.0, 1.0);

    float open = surface.occlusion * ambientVisibility();
    vec3 reflectance = environmentReflectance(f0, surface.roughness, nv);
    vec3 mirrored = reflect(-toEye, surface.normal);
    vec3 color = diffuse * skyIrradiance(surface.normal) * open;
    color += reflectance * skyRadiance(mirrored, surface.roughness) * clamp(open * (0.4 + 0.6 * open), 0.0, 1.0);

    float nl = max(dot(surface.normal, sunDirection.xyz), 0.0);
    float lit = sunVisibility(surface.position, surface.geometric);
    vec3 sunLobe = specularLobe(f0, surface.roughness, surface.normal, toEye, sunDirection.xyz);
    color += (diffuse + sunLobe) * sunColor.rgb * (nl * lit);
#ifdef LOCAL_LIGHTS
    for (int i = 0; i < counts.x; ++i) {
        vec3 toLight;
        vec3 arriving = localLightAt(localLights[i], surface.position, toLight);
        vec3 lobe = specularLobe(f0, surface.roughness, surface.normal, toEye, toLight);
        color += (diffuse + lobe) * arriving * max(dot(surface.normal, toLight), 0.0);
    }
#endif
    return color + surface.emissive;
}

// The same for a matte surface that faces straight up, like the floor: no reflection, which spares half the work.
vec3 shadeMatteUpward(vec3 position, vec3 albedo) {
    const vec3 up = vec3(0.0, 1.0, 0.0);
    vec3 arriving = skyIrradiance(up) * ambientVisibility();
    arriving += sunColor.rgb * (max(sunDirection.y, 0.0) * sunVisibility(position, up));
#ifdef LOCAL_LIGHTS
    for (int i = 0; i < counts.x; ++i) {
        vec3 toLight;
        vec3 light = localLightAt(localLights[i], position, toLight);
        arriving += light * max(toLight.y, 0.0);
    }
#endif
    return albedo * arriving;
}

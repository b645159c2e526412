#include "tone_map.glsl"

#ifdef ENVIRONMENT_MAP
#include "panorama.glsl"
uniform sampler2D panorama;
#endif

// The backdrop seen in a direction: `height` is the direction's y (in parallel projection the height in the picture).
// Half a step of noise is added, or 8 bits show bands in so soft a gradient.
vec3 backdrop(vec3 direction, float height, float noise) {
    float dither = (noise - 0.5) / 255.0;
#ifdef ENVIRONMENT_MAP
    if (environment.w > 0.5) return toneMap(textureLod(panorama, panoramaUv(direction), 0.0).rgb * environment.z) + dither;
#endif
    vec3 below = mix(backgroundHorizon.rgb, backgroundBottom.rgb, smoothstep(0.0, 0.5, -height));
    vec3 above = mix(backgroundHorizon.rgb, backgroundTop.rgb, smoothstep(0.0, 0.55, height));
    return (height < 0.0 ? below : above) + dither;
}

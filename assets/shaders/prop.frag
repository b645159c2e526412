#include "frame.glsl"
#include "lighting.glsl"

in vec3 worldPosition;
in vec3 worldNormal;
in vec3 checkerPosition;
flat in vec4 propColor;
flat in vec4 propMeasures;  // z: roughness, w: size of a checker's square

out vec4 fragment;

// A checkerboard filtered over the pixel (box filter of the square wave: Quilez 2017), 0 or 1.
float checker(vec3 at) {
    // Off the corner planes by an odd fraction, so that a face on a square's border does not flicker.
    vec3 p = at / propMeasures.w + 0.013;
    vec3 width = max(fwidth(p), 1e-4);
    vec3 wave = 2.0 * (abs(fract((p - 0.5 * width) * 0.5) - 0.5) - abs(fract((p + 0.5 * width) * 0.5) - 0.5)) / width;
    return 0.5 - 0.5 * wave.x * wave.y * wave.z;
}

void main() {
    Surface surface;
    surface.position = worldPosition;
    surface.geometric = normalize(worldNormal);
    if (!gl_FrontFacing) surface.geometric = -surface.geometric;
    surface.normal = surface.geometric;
    surface.albedo = propColor.rgb;
    if (propMeasures.w > 0.0) surface.albedo *= mix(0.62, 1.0, checker(checkerPosition));
    surface.metallic = 0.0;
    surface.roughness = propMeasures.z;
    surface.occlusion = 1.0;
    surface.emissive = vec3(0.0);
    fragment = vec4(toneMap(shade(surface)), propColor.a);
}

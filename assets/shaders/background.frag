#include "frame.glsl"
#include "noise.glsl"
#include "background.glsl"

in vec2 screenUv;
out vec4 fragment;

void main() {
    vec4 far = worldFromClip * vec4(screenUv * 2.0 - 1.0, 1.0, 1.0);
    float height = eye.w > 0.5 ? screenUv.y - 0.5 : normalize(far.xyz / far.w - eye.xyz).y;
    fragment = vec4(backdrop(height, pixelNoise()), 1.0);
}

#include "frame.glsl"
#include "noise.glsl"
#include "background.glsl"

in vec2 screenUv;
out vec4 fragment;

void main() {
    vec4 far = worldFromClip * vec4(screenUv * 2.0 - 1.0, 1.0, 1.0);
    vec3 direction = eye.w > 0.5 ? forward.xyz : normalize(far.xyz / far.w - eye.xyz);
    float height = eye.w > 0.5 ? screenUv.y - 0.5 : direction.y;
    fragment = vec4(backdrop(direction, height, pixelNoise()), 1.0);
}

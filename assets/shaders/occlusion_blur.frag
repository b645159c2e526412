// A 4 × 4 box that stays on one surface: takes out the noise of the rotated taps.
#include "frame.glsl"
#include "view_depth.glsl"

uniform sampler2D noisyMap;

in vec2 screenUv;
out float fragment;

void main() {
    float center = viewDistance(textureLod(depthMap, screenUv, 0.0).r);
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -2; y < 2; ++y) {
        for (int x = -2; x < 2; ++x) {
            vec2 uv = screenUv + (vec2(x, y) + 0.5) / depthSize;
            float apart = abs(viewDistance(textureLod(depthMap, uv, 0.0).r) - center);
            float weight = 1e-4 + max(0.0, 1.0 - apart / (0.02 * center + 0.05));
            sum += weight * textureLod(noisyMap, uv, 0.0).r;
            weights += weight;
        }
    }
    fragment = sum / weights;
}

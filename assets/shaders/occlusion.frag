// Ambient occlusion from the depth alone (scalable ambient obscurance: McGuire, Mara, Luebke 2012), at half size.
#include "frame.glsl"
#include "noise.glsl"
#include "view_depth.glsl"

uniform float radiusPixels;  // at one metre from the eye (perspective), or everywhere (orthographic)

in vec2 screenUv;
out float fragment;

const int kTaps = 8;
const float kTurns = 5.0;
const float kRadius = 0.4;  // metres

// From the nearer neighbour on each side: derivatives across an edge would tilt it.
vec3 normalAt(vec3 center, vec2 uv) {
    vec2 texel = 1.0 / depthSize;
    vec3 right = viewPoint(uv + vec2(texel.x, 0.0)) - center;
    vec3 left = center - viewPoint(uv - vec2(texel.x, 0.0));
    vec3 up = viewPoint(uv + vec2(0.0, texel.y)) - center;
    vec3 down = center - viewPoint(uv - vec2(0.0, texel.y));
    vec3 across = dot(right, right) < dot(left, left) ? right : left;
    vec3 along = dot(up, up) < dot(down, down) ? up : down;
    // Right, up and away make a left-handed frame.
    return normalize(cross(along, across));
}

void main() {
    // A loop is left early where nothing was drawn; an early return would not spare a software rasteriser the taps.
    int taps = textureLod(depthMap, screenUv, 0.0).r < 1.0 ? kTaps : 0;
    vec3 center = viewPoint(screenUv);
    vec3 normal = normalAt(center, screenUv);
    float away = eye.w > 0.5 ? 1.0 : center.z;
    float reach = clamp(radiusPixels * kRadius / away, 2.0, 0.25 * depthSize.y);
    float turn = 6.2831853 * pixelNoise();
    float sum = 0.0;
    for (int tap = 0; tap < taps; ++tap) {
        float part = (float(tap) + 0.5) / float(kTaps);
        float angle = part * kTurns * 6.2831853 + turn;
        vec2 uv = screenUv + vec2(cos(angle), sin(angle)) * (part * reach) / depthSize;
        vec3 offset = viewPoint(uv) - center;
        float squared = dot(offset, offset);
        float facing = max(dot(offset, normal) - 0.004 - 0.0008 * center.z, 0.0);
        float window = max(kRadius * kRadius - squared, 0.0) / (kRadius * kRadius);
        sum += window * window * facing * inversesqrt(squared + 1e-4);
    }
    fragment = max(0.0, 1.0 - 3.8 * sum / float(kTaps));
}

// Ambient occlusion from the depth alone (scalable ambient obscurance: McGuire, Mara, Luebke 2012), at half size.
#include "frame.glsl"

uniform sampler2D depthMap;
uniform vec2 depthSize;
uniform float radiusPixels;  // at one metre from the eye (perspective), or everywhere (orthographic)

in vec2 screenUv;
out float fragment;

const int kTaps = 11;
const float kTurns = 7.0;
const float kRadius = 0.35;  // metres

vec3 worldAt(vec2 uv) {
    vec4 world = worldFromClip * vec4(vec3(uv, textureLod(depthMap, uv, 0.0).r) * 2.0 - 1.0, 1.0);
    return world.xyz / world.w;
}

// From the nearer neighbour on each side: derivatives across an edge would tilt it.
vec3 normalAt(vec3 center, vec2 uv) {
    vec2 texel = 1.0 / depthSize;
    vec3 right = worldAt(uv + vec2(texel.x, 0.0)) - center;
    vec3 left = center - worldAt(uv - vec2(texel.x, 0.0));
    vec3 up = worldAt(uv + vec2(0.0, texel.y)) - center;
    vec3 down = center - worldAt(uv - vec2(0.0, texel.y));
    vec3 across = dot(right, right) < dot(left, left) ? right : left;
    vec3 along = dot(up, up) < dot(down, down) ? up : down;
    return normalize(cross(across, along));
}

void main() {
    float depth = textureLod(depthMap, screenUv, 0.0).r;
    if (depth >= 1.0) {
        fragment = 1.0;
        return;
    }
    vec3 center = worldAt(screenUv);
    vec3 normal = normalAt(center, screenUv);
    float away = eye.w > 0.5 ? 1.0 : max(dot(center - eye.xyz, forward.xyz), 1e-3);
    float reach = clamp(radiusPixels * kRadius / away, 2.0, 0.25 * depthSize.y);
    float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    float sum = 0.0;
    for (int tap = 0; tap < kTaps; ++tap) {
        float part = (float(tap) + 0.5) / float(kTaps);
        float angle = part * kTurns * 6.2831853 + turn;
        vec2 uv = screenUv + vec2(cos(angle), sin(angle)) * (part * reach) / depthSize;
        vec3 offset = worldAt(uv) - center;
        float squared = dot(offset, offset);
        float facing = max(dot(offset, normal) - 0.004 - 0.0008 * away, 0.0);
        float window = max(kRadius * kRadius - squared, 0.0) / (kRadius * kRadius);
        sum += window * window * facing * inversesqrt(squared + 1e-4);
    }
    fragment = max(0.0, 1.0 - 2.6 * sum / float(kTaps));
}

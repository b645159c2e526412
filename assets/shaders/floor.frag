#include "frame.glsl"
#include "lighting.glsl"
#include "background.glsl"

in vec3 worldPosition;

out vec4 fragment;

// Coverage of grid lines `spacing` apart and `width` metres wide, filtered over the pixel and faded where they would
// crowd.
float grid(vec2 at, float spacing, float width) {
    vec2 p = at / spacing;
    vec2 footprint = max(fwidth(p), 1e-5);
    vec2 wide = max(vec2(width / spacing), footprint);
    vec2 away = 0.5 - abs(fract(p) - 0.5);
    vec2 line = (1.0 - smoothstep(wide - footprint, wide, away * 2.0)) * clamp(width / spacing / wide, 0.45, 1.0);
    line *= 1.0 - smoothstep(0.15, 0.5, footprint);
    return max(line.x, line.y);
}

void main() {
    vec3 albedo = floorColor.rgb;
    if (floorGrid.x > 0.0) {
        float line = max(0.45 * grid(worldPosition.xz, floorGrid.x, 0.008),
                         0.8 * grid(worldPosition.xz, 4.0 * floorGrid.x, 0.014));
        albedo *= 1.0 - floorGrid.y * line;
    }
    float away = length(worldPosition.xz - target.xz) / floorGrid.z;
    float fade = 1.0 - smoothstep(0.25, 0.97, away);
    vec3 color = toneMap(shadeMatteUpward(worldPosition, albedo));
    // Seen from above it is mixed with the backdrop here, which spares the blending (several samples a pixel). From below
    // it is a veil, so that one can look up through it.
    vec3 toEye = towardsEye(worldPosition);
    if (toEye.y > 0.0) {
        float height = eye.w > 0.5 ? gl_FragCoord.y * viewport.w - 0.5 : -toEye.y;
        fragment = vec4(mix(backdrop(-toEye, height, pixelNoise()), color, fade * fade), 1.0);
    } else {
        fragment = vec4(color, 0.3 * fade * fade);
    }
}

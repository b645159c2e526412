#include "frame.glsl"
#include "lighting.glsl"

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
    Surface surface;
    surface.position = worldPosition;
    surface.geometric = vec3(0.0, 1.0, 0.0);
    surface.normal = surface.geometric;
    surface.albedo = floorColor.rgb;
    surface.metallic = 0.0;
    surface.roughness = 0.85;
    surface.occlusion = 1.0;
    surface.emissive = vec3(0.0);
    if (floorGrid.x > 0.0) {
        float line = max(0.45 * grid(worldPosition.xz, floorGrid.x, 0.008),
                         0.8 * grid(worldPosition.xz, 4.0 * floorGrid.x, 0.014));
        surface.albedo *= 1.0 - floorGrid.y * line;
    }
    float away = length(worldPosition.xz - target.xz) / floorGrid.z;
    float fade = 1.0 - smoothstep(0.25, 0.97, away);
    // From below the floor is a veil, so that one can look up through it.
    float side = towardsEye(worldPosition).y > 0.0 ? 1.0 : 0.3;
    fragment = vec4(toneMap(shade(surface)), fade * fade * side);
}

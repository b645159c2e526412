// Debug shapes: display colours with a soft light from the eye's side, so that their form reads in any scene light.
#include "frame.glsl"

in vec3 worldPosition;
in vec3 worldNormal;
in vec4 color;

uniform float opacity;

out vec4 fragment;

vec3 linearFromSrgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

void main() {
    vec3 normal = normalize(worldNormal);
    float facing = clamp(dot(normal, towardsEye(worldPosition)), 0.0, 1.0);
    float light = 0.55 + 0.3 * facing + 0.15 * normal.y;
    float rim = (1.0 - facing) * (1.0 - facing);
    float alpha = color.a * opacity;
    // Edges a little denser, like glass: the outline reads even where the shape is nearly clear.
    alpha = min(1.0, alpha * (1.0 + 0.9 * rim));
    fragment = vec4(linearFromSrgb(color.rgb) * light, alpha);
}

in vec4 color;
noperspective in float across;

uniform float lineWidth;
uniform float opacity;

out vec4 fragment;

vec3 linearFromSrgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

void main() {
    float edge = clamp(0.5 * lineWidth + 0.5 - abs(across), 0.0, 1.0);
    fragment = vec4(linearFromSrgb(color.rgb), color.a * opacity * edge);
}

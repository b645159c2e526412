#include "frame.glsl"

in vec2 screenUv;
out vec4 fragment;

void main() {
    vec3 color = mix(backgroundBottom.rgb, backgroundTop.rgb, smoothstep(0.0, 1.0, screenUv.y));
    // Half a step of noise, or 8 bits show bands in so soft a gradient (interleaved gradient noise, Jimenez 2014).
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    fragment = vec4(color + (noise - 0.5) / 255.0, 1.0);
}

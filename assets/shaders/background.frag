#include "frame.glsl"

in vec2 screenUv;
out vec4 fragment;

void main() {
    vec4 far = worldFromClip * vec4(screenUv * 2.0 - 1.0, 1.0, 1.0);
    float height = eye.w > 0.5 ? screenUv.y - 0.5 : normalize(far.xyz / far.w - eye.xyz).y;
    vec3 below = mix(backgroundHorizon.rgb, backgroundBottom.rgb, smoothstep(0.0, 0.5, -height));
    vec3 color = height < 0.0 ? below : mix(backgroundHorizon.rgb, backgroundTop.rgb, smoothstep(0.0, 0.55, height));
    // Half a step of noise, or 8 bits show bands in so soft a gradient (interleaved gradient noise, Jimenez 2014).
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    fragment = vec4(color + (noise - 0.5) / 255.0, 1.0);
}

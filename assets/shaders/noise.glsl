// A number in [0, 1) that differs from pixel to pixel without clumps (interleaved gradient noise: Jimenez 2014).
float pixelNoise() {
    return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

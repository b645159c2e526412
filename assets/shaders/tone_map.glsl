// Filmic tone mapping: the ACES reference transform in the fit by Hill (2015), linear sRGB in and out.
vec3 toneMap(vec3 color) {
    const mat3 acesFromRgb = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 rgbFromAces = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = acesFromRgb * (color * forward.w);
    vec3 fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(rgbFromAces * fitted, 0.0, 1.0);
}

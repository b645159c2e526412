// The backdrop seen in a direction: `height` is the direction's y (in parallel projection the height in the picture).
// Half a step of noise is added, or 8 bits show bands in so soft a gradient.
vec3 backdrop(float height, float noise) {
    vec3 below = mix(backgroundHorizon.rgb, backgroundBottom.rgb, smoothstep(0.0, 0.5, -height));
    vec3 above = mix(backgroundHorizon.rgb, backgroundTop.rgb, smoothstep(0.0, 0.55, height));
    return (height < 0.0 ? below : above) + (noise - 0.5) / 255.0;
}

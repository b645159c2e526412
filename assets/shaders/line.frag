in vec4 color;
noperspective in float across;

uniform float lineWidth;
uniform float hiddenOpacity;  // of what lies behind the picture's depth

// One pass draws what is seen and what is hidden: the depth is read instead of tested.
#ifdef MULTISAMPLED
uniform sampler2DMS pictureDepth;
uniform int samples;
#else
uniform sampler2D pictureDepth;
#endif

out vec4 fragment;

vec3 linearFromSrgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

// Share of the pixel's samples at which nothing is nearer.
float seenShare() {
    ivec2 at = ivec2(gl_FragCoord.xy);
#ifdef MULTISAMPLED
    float seen = 0.0;
    for (int i = 0; i < samples; ++i)
        seen += step(gl_FragCoord.z, texelFetch(pictureDepth, at, i).r);
    return seen / float(samples);
#else
    return step(gl_FragCoord.z, texelFetch(pictureDepth, at, 0).r);
#endif
}

void main() {
    float edge = clamp(0.5 * lineWidth + 0.5 - abs(across), 0.0, 1.0);
    fragment = vec4(linearFromSrgb(color.rgb), color.a * mix(hiddenOpacity, 1.0, seenShare()) * edge);
}

// View space from the small depth picture.
uniform sampler2D depthMap;
uniform vec2 depthSize;
uniform vec4 projection;  // of clipFromView: the scales of x, y and z, and the shift of z

// Distance along the view, metres, from a value of the depth buffer.
float viewDistance(float depth) {
    float z = depth * 2.0 - 1.0;
    return eye.w > 0.5 ? (projection.w - z) / projection.z : projection.w / (z + projection.z);
}

// The point seen at `uv`: right, up, distance along the view.
vec3 viewPoint(vec2 uv) {
    float away = viewDistance(textureLod(depthMap, uv, 0.0).r);
    vec2 across = (uv * 2.0 - 1.0) / projection.xy;
    return vec3(eye.w > 0.5 ? across : across * away, away);
}

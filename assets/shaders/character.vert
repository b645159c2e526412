#include "frame.glsl"
#include "instance.glsl"
#include "skinning.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in uvec4 joints;
layout(location = 5) in vec4 weights;
layout(location = 6) in vec4 color;

// The depth pass and the colour pass of a translucent figure must agree to the last bit.
invariant gl_Position;

out vec3 worldPosition;
out vec3 worldNormal;
out vec4 worldTangent;
out vec2 textureUv;
#ifdef VERTEX_COLORS
out vec4 vertexColor;
#endif
flat out vec4 tint;
out vec4 highlight;

// The share of the vertex that belongs to the highlighted joint; all of it when none is named.
float highlightShare(int joint) {
    if (joint < 0) return 1.0;
    return dot(weights, vec4(equal(ivec4(joints), ivec4(joint))));
}

void main() {
    vec4 palette = instanceTexel(5);
    Rows rows = blendedRows(int(palette.x), palette.z > 0.5, joints, weights);
    worldPosition = toWorld(vec4(applyRows(rows, vec4(position, 1.0)), 1.0));
    worldNormal = toWorld(vec4(applyRows(rows, vec4(normal, 0.0)), 0.0));
    worldTangent = vec4(toWorld(vec4(applyRows(rows, vec4(tangent.xyz, 0.0)), 0.0)), tangent.w);
    textureUv = uv;
#ifdef VERTEX_COLORS
    vertexColor = color;
#endif
    tint = instanceTexel(3);
    highlight = instanceTexel(4);
    highlight.a *= highlightShare(int(palette.y));
    gl_Position = clipFromWorld * vec4(worldPosition, 1.0);
}

// Depth only: the shadow map, and the depth that ambient occlusion reads.
#include "instance.glsl"
#include "skinning.glsl"

layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
layout(location = 4) in uvec4 joints;
layout(location = 5) in vec4 weights;
#ifdef ALPHA_MASK
layout(location = 6) in vec4 color;
out float vertexAlpha;
#endif

uniform mat4 depthFromWorld;

// The depth pass and the colour pass of a translucent figure must agree to the last bit.
invariant gl_Position;

out vec2 textureUv;

void main() {
    vec4 palette = instanceTexel(5);
    Rows rows = blendedRows(int(palette.x), palette.z > 0.5, joints, weights);
    textureUv = uv;
#ifdef ALPHA_MASK
    vertexAlpha = color.a;
#endif
    gl_Position = depthFromWorld * vec4(toWorld(vec4(applyRows(rows, vec4(position, 1.0)), 1.0)), 1.0);
}

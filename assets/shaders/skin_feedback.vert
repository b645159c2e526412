// The skinning alone, captured by transform feedback to compare it with the CPU's.
#include "skinning.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 4) in uvec4 joints;
layout(location = 5) in vec4 weights;

uniform int dual;  // 1: the palette holds dual quaternions

out vec3 skinnedPosition;
out vec3 skinnedNormal;
out vec3 skinnedTangent;

void main() {
    Rows rows = blendedRows(0, dual == 1, joints, weights);
    skinnedPosition = applyRows(rows, vec4(position, 1.0));
    skinnedNormal = normalize(applyRows(rows, vec4(normal, 0.0)));
    skinnedTangent = applyRows(rows, vec4(tangent.xyz, 0.0));
    gl_Position = vec4(skinnedPosition, 1.0);
}

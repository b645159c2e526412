// Shape vertices hold a part that grows with the radius and a part that grows with the half extents (or with a
// capsule's half length), so that one mesh a kind serves every size.
#include "instance.glsl"

layout(location = 0) in vec3 roundPart;
layout(location = 1) in vec3 extentPart;
layout(location = 2) in vec3 normal;

vec3 shapePosition() {
    vec4 measures = instanceTexel(4);
    return roundPart * measures.x + extentPart * instanceTexel(5).xyz;
}

#include "frame.glsl"
#include "prop.glsl"

out vec3 worldPosition;
out vec3 worldNormal;
out vec3 checkerPosition;
flat out vec4 propColor;
flat out vec4 propMeasures;

// The world's translation of the shape, along the shape's axes.
vec3 shapeOriginInItsAxes() {
    mat3 rows = mat3(instanceTexel(0).xyz, instanceTexel(1).xyz, instanceTexel(2).xyz);
    return rows * vec3(instanceTexel(0).w, instanceTexel(1).w, instanceTexel(2).w);
}

void main() {
    vec3 localPosition = shapePosition();
    worldPosition = toWorld(vec4(localPosition, 1.0));
    checkerPosition = localPosition + instanceTexel(5).w * shapeOriginInItsAxes();
    worldNormal = toWorld(vec4(normal, 0.0));
    propColor = instanceTexel(3);
    propMeasures = instanceTexel(4);
    gl_Position = clipFromWorld * vec4(worldPosition, 1.0);
}

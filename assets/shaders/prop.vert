#include "frame.glsl"
#include "prop.glsl"

out vec3 worldPosition;
out vec3 worldNormal;
out vec3 localPosition;
flat out vec4 propColor;
flat out vec4 propMeasures;

void main() {
    localPosition = shapePosition();
    worldPosition = toWorld(vec4(localPosition, 1.0));
    worldNormal = toWorld(vec4(normal, 0.0));
    propColor = instanceTexel(3);
    propMeasures = instanceTexel(4);
    gl_Position = clipFromWorld * vec4(worldPosition, 1.0);
}

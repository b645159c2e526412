#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 solidColor;

out vec3 worldPosition;
out vec3 worldNormal;
out vec4 color;

void main() {
    worldPosition = position;
    worldNormal = normal;
    color = solidColor;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}

#include "prop.glsl"

uniform mat4 depthFromWorld;

void main() {
    gl_Position = depthFromWorld * vec4(toWorld(vec4(shapePosition(), 1.0)), 1.0);
}

// A square around what the camera looks at; the fragment shader melts it into the background before its edge.
#include "frame.glsl"

uniform mat4 depthFromWorld;  // clipFromWorld in the picture

out vec3 worldPosition;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    worldPosition = vec3(target.x + corner.x * floorGrid.z, floorColor.w, target.z - corner.y * floorGrid.z);
    gl_Position = depthFromWorld * vec4(worldPosition, 1.0);
}

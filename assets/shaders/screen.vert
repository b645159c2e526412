// One triangle over the whole picture.
out vec2 screenUv;

void main() {
    screenUv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(screenUv * 2.0 - 1.0, 1.0, 1.0);
}

// Each segment is an instance of a strip of four vertices, widened in screen space: core profiles only promise lines of
// one pixel.
#include "frame.glsl"

layout(location = 0) in vec3 from;
layout(location = 1) in vec4 fromColor;
layout(location = 2) in vec3 to;
layout(location = 3) in vec4 toColor;

uniform float lineWidth;

out vec4 color;
noperspective out float across;

void main() {
    vec4 a = clipFromWorld * vec4(from, 1.0);
    vec4 b = clipFromWorld * vec4(to, 1.0);
    // What lies behind the near plane is cut off, or the division below would mirror it.
    float da = a.z + a.w;
    float db = b.z + b.w;
    if (da < 0.0 && db < 0.0) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    vec4 cutA = da < 0.0 ? mix(a, b, da / (da - db)) : a;
    vec4 cutB = db < 0.0 ? mix(b, a, db / (db - da)) : b;
    vec2 pixelA = cutA.xy / cutA.w * viewport.xy * 0.5;
    vec2 pixelB = cutB.xy / cutB.w * viewport.xy * 0.5;
    vec2 along = pixelB - pixelA;
    along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
    float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
    bool atEnd = gl_VertexID >= 2;
    vec4 clip = atEnd ? cutB : cutA;
    float halfWidth = 0.5 * lineWidth + 0.5;
    vec2 offset = (vec2(-along.y, along.x) * side * halfWidth + along * (atEnd ? 0.5 : -0.5)) * 2.0 * viewport.zw;
    color = atEnd ? toColor : fromColor;
    across = side * halfWidth;
    // A little nearer than the surface it lies on.
    gl_Position = clip + vec4(offset * clip.w, -2e-5 * clip.w, 0.0);
}

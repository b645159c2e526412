// Per-instance data, six texels each (InstanceTexels in src/render/gl/frame_uniforms.hpp):
//   0..2  rows of worldFromModel
//   3..5  characters: tint and opacity; highlight; first palette joint, highlighted joint, 1 for
//                     dual quaternions
//         props:      colour; radius, half length, roughness, checker size; half extents and
//                     1 when the checker lies in the world
uniform samplerBuffer instances;
uniform int firstInstance;

const int kTexelsAnInstance = 6;

vec4 instanceTexel(int which) {
    return texelFetch(instances, (firstInstance + gl_InstanceID) * kTexelsAnInstance + which);
}

// Rows 0..2 applied to a point (w = 1) or a direction (w = 0).
vec3 toWorld(vec4 v) {
    return vec3(dot(instanceTexel(0), v), dot(instanceTexel(1), v), dot(instanceTexel(2), v));
}

// Linear blend skinning, the same as animation::skinVertices: the rows of the joints' matrices, weighted and summed.
uniform samplerBuffer palettes;  // three texels a joint: the rows of SkinMatrix

struct Rows {
    vec4 x;
    vec4 y;
    vec4 z;
};

Rows blendedRows(int firstJoint, uvec4 joints, vec4 weights) {
    Rows rows = Rows(vec4(0.0), vec4(0.0), vec4(0.0));
    for (int slot = 0; slot < 4; ++slot) {
        int texel = 3 * (firstJoint + int(joints[slot]));
        rows.x += weights[slot] * texelFetch(palettes, texel);
        rows.y += weights[slot] * texelFetch(palettes, texel + 1);
        rows.z += weights[slot] * texelFetch(palettes, texel + 2);
    }
    return rows;
}

vec3 applyRows(Rows rows, vec4 v) {
    return vec3(dot(rows.x, v), dot(rows.y, v), dot(rows.z, v));
}

// Linear blend and dual quaternion skinning, the same as animation::skinVertices and skinVerticesDual.
uniform samplerBuffer palettes;  // three texels a joint: the rows of SkinMatrix, or DualQuaternion's real and dual

struct Rows {
    vec4 x;
    vec4 y;
    vec4 z;
};

// The rows of the rigid motion of a dual quaternion of any length above zero.
Rows rowsOfDualQuaternion(vec4 real, vec4 dual) {
    float scale = inversesqrt(dot(real, real));
    vec4 q = real * scale;
    vec4 d = dual * (2.0 * scale);
    vec3 moved = q.w * d.xyz - d.w * q.xyz + cross(q.xyz, d.xyz);
    vec3 twice = 2.0 * q.xyz;
    vec3 squares = twice * q.xyz;
    vec3 mixed = twice * q.yzx;  // xy, yz, zx
    vec3 turned = twice * q.w;
    return Rows(vec4(1.0 - squares.y - squares.z, mixed.x - turned.z, mixed.z + turned.y, moved.x),
                vec4(mixed.x + turned.z, 1.0 - squares.x - squares.z, mixed.y - turned.x, moved.y),
                vec4(mixed.z - turned.y, mixed.y + turned.x, 1.0 - squares.x - squares.y, moved.z));
}

// Both ways share the loop, as a software rasteriser would run both sides of an if. What tells them apart is the sign:
// a dual quaternion is taken in the half space of the strongest joint's, which the first slot names.
Rows blendedRows(int firstJoint, bool dual, uvec4 joints, vec4 weights) {
    Rows rows = Rows(vec4(0.0), vec4(0.0), vec4(0.0));
    vec4 strongest = texelFetch(palettes, 3 * (firstJoint + int(joints[0])));
    for (int slot = 0; slot < 4 && weights[slot] > 0.0; ++slot) {  // strongest first: the rest is zero too
        int texel = 3 * (firstJoint + int(joints[slot]));
        vec4 first = texelFetch(palettes, texel);
        float weight = dual && dot(first, strongest) < 0.0 ? -weights[slot] : weights[slot];
        rows.x += weight * first;
        rows.y += weight * texelFetch(palettes, texel + 1);
        rows.z += weight * texelFetch(palettes, texel + 2);
    }
    if (dual) return rowsOfDualQuaternion(rows.x, rows.y);
    return rows;
}

vec3 applyRows(Rows rows, vec4 v) {
    return vec3(dot(rows.x, v), dot(rows.y, v), dot(rows.z, v));
}

// What all shaders of a frame share; the block mirrors FrameUniforms in src/render/gl/frame_uniforms.hpp.
const int kMaxLocalLights = 8;

struct LocalLight {
    vec4 positionRange;    // world position, range in metres
    vec4 directionCosine;  // unit direction of a spot, cosine of its outer angle
    vec4 colorCosine;      // colour times intensity, cosine of its inner angle
};

layout(std140) uniform Frame {
    mat4 clipFromWorld;
    mat4 viewFromWorld;
    mat4 worldFromClip;
    mat4 shadowFromWorld;  // to [0, 1]³ of the shadow map
    vec4 eye;              // xyz world position; w: 1 when orthographic
    vec4 forward;          // xyz unit view direction; w: exposure
    vec4 sunDirection;     // xyz unit, towards the light; w: 1 when it casts a shadow
    vec4 sunColor;         // rgb times intensity; w: side of the shadow map / its depth, in metres
    // x: metres a texel; y: 1 / texels a side; z: radius of the penumbra for a gap of the map's whole depth, of the map's
    // side; w: its largest radius, of the map's side
    vec4 shadowTexel;
    vec4 skyZenith;
    vec4 skyHorizon;
    vec4 skyGround;
    vec4 viewport;         // width, height, 1 / width, 1 / height
    vec4 floorColor;       // rgb linear; w: height
    vec4 floorGrid;        // spacing, strength, fade distance; w: 1 when there is a floor
    vec4 target;           // xyz: what the camera looks at; w: 1 when ambient occlusion is on
    vec4 backgroundTop;
    vec4 backgroundHorizon;
    vec4 backgroundBottom;
    vec4 environment;      // intensity, last level of the reflections, gain of the panorama; w: 1 when it is seen
    vec4 environmentDiffuse[9];
    ivec4 counts;          // x: local lights
    LocalLight localLights[kMaxLocalLights];
};

// Unit direction from a world point to the eye.
vec3 towardsEye(vec3 world) {
    return eye.w > 0.5 ? -forward.xyz : normalize(eye.xyz - world);
}

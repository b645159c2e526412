#ifdef ALPHA_MASK
uniform sampler2D baseColorTexture;
uniform vec4 baseColor;
uniform float alphaCutoff;
in vec2 textureUv;
in float vertexAlpha;
#endif

void main() {
#ifdef ALPHA_MASK
    if (vertexAlpha * baseColor.a * texture(baseColorTexture, textureUv).a < alphaCutoff) discard;
#endif
}

#include "render/gl/shown_picture.hpp"

#include "render/gl/gl_object.hpp"

namespace lutka::render {

struct ShownPicture::State {
    GlTexture texture = GlTexture::create();
};

ShownPicture::ShownPicture(const Image& image) : state_(std::make_unique<State>()), size_(image.size()) {
    glBindTexture(GL_TEXTURE_2D, state_->texture.name());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 image.rgba.data());
    glBindTexture(GL_TEXTURE_2D, 0);
}

ShownPicture::ShownPicture(ShownPicture&&) noexcept = default;
ShownPicture& ShownPicture::operator=(ShownPicture&&) noexcept = default;
ShownPicture::~ShownPicture() = default;

unsigned int ShownPicture::texture() const {
    return state_->texture.name();
}

}  // namespace lutka::render

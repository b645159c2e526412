#pragma once

#include <vector>

#include "gl_fixture.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

/// A frame with the hand-made figure in its bind pose.
struct LoneFigure {
    animation::Character biped = makeBiped();
    std::vector<animation::SkinMatrix> palette = bindPalette(biped.skeleton);
    render::FrameDescription frame;

    explicit LoneFigure(GlFixture& gl) {
        render::CharacterItem item;
        item.character = gl.upload(biped);
        item.palette = palette;
        frame.characters.push_back(item);
    }
};

}  // namespace lutka::test

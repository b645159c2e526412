#pragma once

#include <string>
#include <string_view>

namespace lutka::animation::rig_import {

/// A material script of Ogre as Assimp 5.2.5 can read it: it waits for ever for the number of a colour that is given as
/// `vertexcolour`, and for the end of a block that is cut off. Such lines are left out, and blocks are closed.
[[nodiscard]] std::string tidyOgreMaterial(std::string_view text);

}  // namespace lutka::animation::rig_import

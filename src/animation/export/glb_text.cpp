#include "animation/export/glb_parts.hpp"
#include "core/utf8.hpp"

namespace lutka::animation::glb {

std::string utf8(std::string_view text) {
    return wellFormedUtf8(text, "?");
}

}  // namespace lutka::animation::glb

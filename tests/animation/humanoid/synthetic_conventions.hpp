#pragma once

#include <span>

namespace lutka::test {

/// The joints of a rig as one naming convention has them.
struct Convention {
    const char* name;
    const char* left;  ///< What stands for '@' in the names of the left side.
    const char* right;
    /// A line a joint, "name parent place role". '@' in a name stands for the side (such lines make two joints), '~'
    /// for a blank. A place in brackets carries no skin. Role '-' is none, '+' a joint of the spine, '*' the chest.
    const char* joints;
};

[[nodiscard]] std::span<const Convention> conventions();

}  // namespace lutka::test

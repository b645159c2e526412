#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "animation/import/gltf/gltf_file.hpp"
#include "core/math.hpp"

namespace lutka::animation::rig_import::gltf {

/// The numbers of an accessor, element after element.
struct Numbers {
    std::vector<float> values;  ///< count × width.
    std::size_t count = 0;
    std::size_t width = 1;  ///< Components of an element: 1 for SCALAR, 3 for VEC3, 16 for MAT4 …

    [[nodiscard]] float at(std::size_t element, std::size_t component) const {
        return values[element * width + component];
    }
    [[nodiscard]] vec3 vector3(std::size_t element) const { return {at(element, 0), at(element, 1), at(element, 2)}; }
};

/// What a normalised integer stands for, in [-1, 1]: the equations of the specification's section 3.11.
template <class T>
[[nodiscard]] float fraction(T value) {
    const float scaled = static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max());
    return std::max(scaled, -1.0F);
}

/// Reads an accessor as the specification means it: any component type, normalised integers as fractions, any stride,
/// sparse replacements, zeros where it has no buffer view. Throws Damage where it leaves its buffer or has absurd
/// counts.
[[nodiscard]] Numbers readNumbers(GltfFile& file, int accessor);
/// The same, which must have that many components.
[[nodiscard]] Numbers readNumbers(GltfFile& file, int accessor, std::size_t width, const char* what);
/// Unsigned integers as they are (indices, joints), element after element.
[[nodiscard]] std::vector<std::uint32_t> readIntegers(GltfFile& file, int accessor, std::size_t width,
                                                      const char* what);

}  // namespace lutka::animation::rig_import::gltf

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "animation/import/fbx/document.hpp"

namespace lutka::animation::rig_import::fbx {

/// A corner of a polygon.
struct Corner {
    std::size_t place = 0;  ///< Among all corners of the geometry.
    std::uint32_t controlPoint = 0;
    std::size_t polygon = 0;
};

/// A geometry's data of one kind (normals, UVs, colours, materials) with the way in which it is laid out.
class LayerElement {
  public:
    LayerElement() = default;
    /// `values` and `indices` name the child records; `width` numbers make a value.
    LayerElement(const Record& record, const char* values, const char* indices, std::size_t width);

    [[nodiscard]] bool empty() const { return values_.empty(); }
    /// The value at a corner, zeros where the file has none.
    template <std::size_t Width>
    [[nodiscard]] std::array<float, Width> at(const Corner& corner) const {
        std::array<float, Width> out{};
        const std::size_t start = indexAt(corner) * Width;
        for (std::size_t i = 0; i < Width; ++i) {
            // Overflowing sums would wrap a damaged index back into the array.
            if (start < values_.size() && start + i < values_.size()) out[i] = static_cast<float>(values_[start + i]);
        }
        return out;
    }

  private:
    enum class Mapping { corner, controlPoint, polygon, same };

    [[nodiscard]] std::size_t indexAt(const Corner& corner) const;

    Mapping mapping_ = Mapping::corner;
    std::vector<double> values_;
    std::vector<double> indices_;  // empty: values are in order
};

}  // namespace lutka::animation::rig_import::fbx

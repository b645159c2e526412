#pragma once

#include <tiny_gltf.h>

#include <cstring>
#include <span>
#include <vector>

#include "core/math.hpp"

namespace lutka::animation::glb {

/// Appends arrays to the model's one binary buffer, each with a view and an accessor of its own.
class BufferBuilder {
  public:
    explicit BufferBuilder(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

    /// Index of a new accessor over `values`, elements of `type` (TINYGLTF_TYPE_…) with components of `componentType`.
    /// `target` is 0 for what is no vertex or index data.
    template <class T>
    int add(std::span<const T> values, int componentType, int type, int target) {
        tinygltf::Accessor accessor;
        accessor.bufferView = addBytes(values.data(), values.size_bytes(), target);
        accessor.componentType = componentType;
        accessor.type = type;
        accessor.count = values.size();
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    /// The same for floats, with the bounds that glTF demands of positions and key times.
    template <class T>
    int addBounded(std::span<const T> values, int type, int target) {
        const int index = add(values, TINYGLTF_COMPONENT_TYPE_FLOAT, type, target);
        const auto* floats = reinterpret_cast<const float*>(values.data());
        constexpr std::size_t kComponents = sizeof(T) / sizeof(float);  // NOLINT(bugprone-sizeof-expression)
        std::vector<double> low(kComponents, 0.0);
        std::vector<double> high(kComponents, 0.0);
        for (std::size_t i = 0; i < values.size() * kComponents; ++i) {
            const double value = floats[i];
            const std::size_t c = i % kComponents;
            low[c] = i < kComponents ? value : std::min(low[c], value);
            high[c] = i < kComponents ? value : std::max(high[c], value);
        }
        model_.accessors[index].minValues = low;
        model_.accessors[index].maxValues = high;
        return index;
    }

    /// Index of a new view over the bytes, aligned to four bytes.
    int addBytes(const void* data, std::size_t size, int target) {
        std::vector<unsigned char>& bytes = model_.buffers[0].data;
        bytes.resize((bytes.size() + 3) / 4 * 4);
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = bytes.size();
        view.byteLength = size;
        view.target = target;
        const auto* first = static_cast<const unsigned char*>(data);
        bytes.insert(bytes.end(), first, first + size);
        model_.bufferViews.push_back(std::move(view));
        return static_cast<int>(model_.bufferViews.size()) - 1;
    }

    [[nodiscard]] std::size_t size() const { return model_.buffers[0].data.size(); }

  private:
    tinygltf::Model& model_;
};

}  // namespace lutka::animation::glb

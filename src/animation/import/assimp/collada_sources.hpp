#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "animation/import/assimp/collada_tags.hpp"

namespace lutka::animation::rig_import {

/// A <source> of an animation; points into the document's text.
struct ColladaSource {
    std::vector<double> numbers;
    std::vector<std::string_view> names;
    bool bends = false;  ///< A name is of a curve that is no straight line.
    std::size_t stride = 1;
    std::string_view params;  ///< The text in its accessor.
};

/// The numbers of a tidied text; none where one of them is no number: half a curve would be another curve.
[[nodiscard]] std::vector<double> colladaNumbers(std::string_view text);

/// The sources of a document's animations by their ids.
[[nodiscard]] std::map<std::string, ColladaSource> colladaSources(std::string_view text,
                                                                  const std::vector<ColladaTag>& tags);

/// A document in which the params of an animation's accessors are as many numbers as its stride. Assimp 5.2.5 counts
/// one for all types but float4x4, and so takes one number of a float3, and none where no param stands.
[[nodiscard]] std::string withPlainParams(const std::string& text);

/// A <source> with its numbers and the text in its accessor.
[[nodiscard]] std::string colladaSourceText(const std::string& id, const std::vector<double>& numbers,
                                            std::size_t stride, std::string_view params);

}  // namespace lutka::animation::rig_import

#pragma once

#include <filesystem>
#include <system_error>

#include "bindings/errors.hpp"

namespace lutka::python {

/// Raises UsageError where the file that is to be written is the model itself, which would be destroyed.
inline void keepModel(const std::filesystem::path& file, const std::filesystem::path& model) {
    std::error_code failed;
    if (model.empty() || !std::filesystem::equivalent(file, model, failed)) return;
    raise({ErrorCode::usage, "that file is the model itself", file.string(), "choose another name"});
}

}  // namespace lutka::python

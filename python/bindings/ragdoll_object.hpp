#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "bindings/keywords.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::python {

/// A character with its ragdoll; never changed once it is made, so that simulations may share it.
using RagdollPointer = std::shared_ptr<const scene::RagdollAsset>;

/// What Python holds of it.
struct RagdollObject {
    RagdollPointer asset;
};

/// Import options from the keywords scale, up, figure, textures, allow_outside, in_process and import_memory. Reading
/// stops when a signal handler raises.
[[nodiscard]] animation::ImportOptions importOptions(Keywords& keywords);
/// Those and the keywords of the fit.
[[nodiscard]] scene::LoadOptions loadOptions(Keywords& keywords);

/// Python's view of the meshes, of Map and of Checkup; map(), build(), check() and export().
void bindRagdoll(py::module_& module);

}  // namespace lutka::python

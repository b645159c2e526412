#pragma once

#include "editor/states/workspace.hpp"

/// The handlers of the states; workspace.hpp's makeHandlers() puts them together.
namespace lutka::editor {

[[nodiscard]] std::unique_ptr<StateHandler> makeSelectHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeGrabHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeRotateHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeScaleHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeCameraMoveHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeCameraRotateHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeAddHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeDeleteHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeHandleHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makePickJointHandler(Workspace& workspace);
[[nodiscard]] std::unique_ptr<StateHandler> makeBoxHandler(Workspace& workspace);

}  // namespace lutka::editor

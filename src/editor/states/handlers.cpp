#include "editor/states/states.hpp"

namespace lutka::editor {

StateMachine::Handlers makeHandlers(Workspace& workspace) {
    return {makeSelectHandler(workspace),       makeSelectHandler(workspace),    makeGrabHandler(workspace),
            makeRotateHandler(workspace),       makeScaleHandler(workspace),     makeCameraMoveHandler(workspace),
            makeCameraRotateHandler(workspace), makeAddHandler(workspace),       makeDeleteHandler(workspace),
            makeHandleHandler(workspace),       makePickJointHandler(workspace), makeBoxHandler(workspace)};
}

}  // namespace lutka::editor

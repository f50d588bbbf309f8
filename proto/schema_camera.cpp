#include "proto/schema_camera.h"

#include "proto/schema_values.h"

namespace antipode {

void readCamera(const schema::Camera& from, const ReadContext& context, Camera& camera) {
    readFields(from, "camera", context, camera);
    if (from.look_at_size() == 0) return;
    if (from.forward_size() > 0) failAt("camera", "needs either look_at or forward, not both");
    const Vec3d towards = Vec3d(readVec3(from.look_at(), "camera: look_at")) - Vec3d(camera.position);
    if (!(length(towards) > 0)) failAt("camera: look_at", "must differ from position");
    camera.forward = Vec3f(normalize(towards));
    if (!from.has_focus_distance()) camera.focusDistance = float(length(towards));
}

}  // namespace antipode

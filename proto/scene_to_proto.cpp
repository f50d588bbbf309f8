#include "proto/schema_fields.h"

namespace antipode {

schema::Scene toProto(const Scene& scene, Arrays arrays) {
    schema::Scene out;
    writeFields(scene, arrays, out);
    return out;
}

}  // namespace antipode

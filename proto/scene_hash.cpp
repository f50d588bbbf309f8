#include <span>

#include "renderengine/sha256.h"
#include "proto/scene_loader.h"
#include "renderengine/io/text.h"
#include "scene/scene_fields.h"

namespace antipode {
namespace {

static_assert(sizeof(Vec3f) == 12, "three floats without padding");

/// SHA-256 over a sequence of values. Every list is preceded by its length, so that no two scenes give the same bytes.
class Hasher {
public:
    /// Indices, sizes, flags and enumerators.
    template <class T>
    requires std::is_integral_v<T> || std::is_enum_v<T>
    void add(T v) { digest_.addValue(uint64_t(v)); }
    void add(float v) { digest_.addValue(v); }
    void add(const Vec3f& v) { digest_.addValues(std::span(&v, 1)); }
    template <class T>
    void add(const std::optional<T>& v) {
        add(uint64_t(v.has_value()));
        if (v) add(*v);
    }
    template <class T>
    void add(const std::vector<T>& values) {
        add(uint64_t(values.size()));
        if constexpr (HasFields<T>) {
            for (const T& value : values) add(value);
        } else {
            digest_.addValues(std::span<const T>(values));
        }
    }
    template <HasFields S>
    void add(const S& object) {
        forEachField(object, [&](auto field, const auto& value) {
            if constexpr (field.role != Role::Name) add(value);
        });
    }

    std::string hex() { return hexadecimal(digest_.finish()); }

private:
    Sha256 digest_;
};

}  // namespace

std::string sceneHash(const Scene& scene) {
    Hasher h;
    h.add(uint64_t(1));  // the layout's version: a change of the tables' order must change every hash
    h.add(scene);
    return h.hex();
}

}  // namespace antipode

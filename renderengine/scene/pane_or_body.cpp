#include "scene/pane_or_body.h"

#include "scene/mesh_fronts.h"

namespace antipode {

void makeClosedGlassSolid(Scene& scene) {
    const size_t count = scene.materials.size();
    for (uint32_t i = 0; i < count; ++i) {
        if (!scene.materials[i].transmits() || !scene.materials[i].thin) continue;
        std::vector<Mesh*> closed;
        bool sheets = false;
        for (Mesh& mesh : scene.meshes) {
            if (mesh.material != i) continue;
            if (enclosedVolume(mesh).value_or(0) != 0)
                closed.push_back(&mesh);
            else
                sheets = true;
        }
        if (closed.empty()) continue;
        uint32_t solid = i;
        if (sheets) {
            solid = uint32_t(scene.materials.size());
            scene.materials.push_back(Material(scene.materials[i]));
        }
        scene.materials[solid].thin = false;
        scene.notices.push_back("Material '" + scene.materials[i].name +
                                "' is glass without a thickness; its closed meshes are solid, its sheets are panes.");
        for (Mesh* mesh : closed) mesh->material = solid;
    }
}

}  // namespace antipode

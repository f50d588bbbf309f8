#include "scene/import_nodes.h"

namespace antipode {
namespace {

Affine toAffine(const aiMatrix4x4& m) {
    return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

void visitBelow(const aiNode& node, const Affine& parent,
                const std::function<void(const aiNode&, const Affine&)>& visit) {
    const Affine map = parent * toAffine(node.mTransformation);
    visit(node, map);
    for (unsigned i = 0; i < node.mNumChildren; ++i) visitBelow(*node.mChildren[i], map, visit);
}

}  // namespace

void visitNodes(const aiNode& root, const std::function<void(const aiNode&, const Affine&)>& visit) {
    visitBelow(root, Affine{}, visit);
}

Affine nodeToWorld(const aiScene& file, const std::string& name) {
    Affine found;
    visitNodes(*file.mRootNode, [&](const aiNode& node, const Affine& map) {
        if (name == node.mName.C_Str()) found = map;
    });
    return found;
}

}  // namespace antipode

#include "scene/upright.h"

namespace antipode {
namespace {

double metresPerUnit(const aiScene& file, ModelFormat format) {
    float centimetres = 1;
    if (format != ModelFormat::Fbx) return 1;
    if (file.mMetaData) file.mMetaData->Get("UnitScaleFactor", centimetres);
    return centimetres > 0 ? centimetres * 0.01 : 0.01;
}

/// 0, 1, 2 for X, Y, Z.
int upAxis(const aiScene& file, ModelFormat format, const ImportOptions& options) {
    if (options.up != UpAxis::AsInFile) return options.up == UpAxis::Z ? 2 : 1;
    if (format == ModelFormat::Stl) return 2;
    int axis = 1;
    if (format == ModelFormat::Fbx && file.mMetaData) file.mMetaData->Get("UpAxis", axis);
    return axis;
}

}  // namespace

void standUpright(const aiScene& file, ModelFormat format, const ImportOptions& options) {
    const auto s = ai_real(metresPerUnit(file, format));
    aiMatrix4x4 turn;
    switch (upAxis(file, format, options)) {
        case 0: turn = aiMatrix4x4(0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1); break;
        case 2: turn = aiMatrix4x4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1); break;
        default: break;
    }
    aiMatrix4x4 scale;
    aiMatrix4x4::Scaling(aiVector3D(s, s, s), scale);
    file.mRootNode->mTransformation = turn * scale * file.mRootNode->mTransformation;
}

}  // namespace antipode

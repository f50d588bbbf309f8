#include "gpu/layer_tables.h"

#include <cmath>

#include "gpu/loss_values.h"
#include "gpu/table_nodes.h"

namespace antipode {

std::vector<vec4> packLayerAlbedos() {
    std::vector<vec4> texels;
    packCells(kCoatAlbedos, texels);
    for (uint i = 0; i + 1 < ALBEDO_ROUGHNESSES; ++i)
        texels.push_back(
            {kCoatMeanAlbedos[i], kCoatMeanAlbedos[i + 1], kCoatSchlickMeans[i], kCoatSchlickMeans[i + 1]});
    packCells(kSheenAlbedos, texels);
    return texels;
}

double tabulatedCoatAlbedo(double cosine, double roughness) {
    return lookUpCells(kCoatAlbedos, std::sqrt(cosine), roughness);
}

double tabulatedCoatMeanAlbedo(double roughness) { return lookUpNodes(kCoatMeanAlbedos, roughness); }

double tabulatedCoatSchlickMean(double roughness) { return lookUpNodes(kCoatSchlickMeans, roughness); }

double tabulatedSheenAlbedo(double cosine, double roughness) {
    return lookUpCells(kSheenAlbedos, std::sqrt(cosine), (roughness - leastSheenRoughness) / (1 - leastSheenRoughness));
}

}  // namespace antipode

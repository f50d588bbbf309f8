// Tables of what single scattering at microfacets loses (gpu/loss_tables.h).
#ifndef ANTIPODE_LOSSES
#define ANTIPODE_LOSSES
layout(set = 0, binding = BIND_LOSSES) uniform samplerBuffer losses;

const uint LOSS_ROW = LOSS_COSINES - 1u, LOSS_CELLS = LOSS_ROW * (LOSS_ROUGHNESSES - 1u);

/// Where a position in [0,1] lies among the nodes of an axis: the first of two, and how far from it.
uint lossNode(real position, uint nodes, out real rest) {
    real at = position * real(nodes - 1u);
    uint first = min(uint(at), nodes - 2u);
    rest = at - real(first);
    return first;
}

/// Losses change where the cosine is about α, and steeply near 0.
real lossColumn(real cosine, real alpha) { return sqrt(cosine * (1.0 + 3.0 * alpha) / (cosine + 3.0 * alpha)); }

/// The part of light from a direction of this cosine > 0 that white facets do not reflect at once.
real metalLoss(real cosine, real alpha) {
    real x, y;
    uint column = lossNode(lossColumn(cosine, alpha), LOSS_COSINES, x),
         row = lossNode(sqrt(alpha), LOSS_ROUGHNESSES, y);
    real4 corners = texelFetch(losses, int(row * LOSS_ROW + column));
    return mix(mix(corners.x, corners.y, x), mix(corners.z, corners.w, x), y);
}

/// Its cosine-weighted mean.
real metalMeanLoss(real alpha) {
    real y;
    uint node = lossNode(sqrt(sqrt(alpha)), LOSS_MEANS, y);
    real4 means = texelFetch(losses, int(LOSS_CELLS + node));
    return alpha * mix(means.x, means.y, y);
}

// Behind them those of glass: a table for each index, from outside and from inside, and the means of both.
const uint GLASS_LOSS_FIRST = LOSS_CELLS + LOSS_MEANS - 1u, GLASS_LOSS_TABLE = LOSS_ROW * (GLASS_LOSS_ROUGHNESSES - 1u),
           GLASS_LOSS_MEANS_FIRST = GLASS_LOSS_FIRST + 2u * GLASS_LOSS_INDICES * GLASS_LOSS_TABLE;

/// Where an index of refraction lies among the tables. eta: index beyond over index on the side in question.
uint glassLossIndex(real eta, out real rest) {
    return lossNode(abs(eta - 1.0) / (eta + 1.0), GLASS_LOSS_INDICES, rest);
}

/// The part of light from a direction of this cosine > 0 that glass neither reflects nor passes on at once.
real glassLoss(real cosine, real alpha, real eta) {
    real x, y, z;
    uint column = lossNode(lossColumn(cosine, alpha), LOSS_COSINES, x),
         row = lossNode(sqrt(alpha), GLASS_LOSS_ROUGHNESSES, y), index = glassLossIndex(eta, z);
    uint table = index + (eta < 1.0 ? GLASS_LOSS_INDICES : 0u);
    int at = int(GLASS_LOSS_FIRST + table * GLASS_LOSS_TABLE + row * LOSS_ROW + column);
    real4 corners = mix(real4(texelFetch(losses, at)), real4(texelFetch(losses, at + int(GLASS_LOSS_TABLE))), z);
    return mix(mix(corners.x, corners.y, x), mix(corners.z, corners.w, x), y);
}

/// Their cosine-weighted means on this side and beyond.
real2 glassMeanLosses(real alpha, real eta) {
    real y, z;
    uint node = lossNode(sqrt(sqrt(alpha)), GLASS_LOSS_MEANS, y), index = glassLossIndex(eta, z);
    int at = int(GLASS_LOSS_MEANS_FIRST + index * (GLASS_LOSS_MEANS - 1u) + node);
    real4 means = mix(real4(texelFetch(losses, at)), real4(texelFetch(losses, at + int(GLASS_LOSS_MEANS - 1u))), z);
    real2 sides = alpha * mix(means.xz, means.yw, y);
    return eta < 1.0 ? sides.yx : sides;
}
#endif

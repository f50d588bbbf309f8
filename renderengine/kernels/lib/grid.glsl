// The hash grid over light vertices: cubes a little larger than the merge diameter, so that a query meets at most
// 2×2×2.
#ifndef ANTIPODE_GRID
#define ANTIPODE_GRID

ivec3 cellOf(real3 position) { return ivec3(floor((position - job.gridOrigin.xyz) / push.cellSize)); }

/// Bucket of a cell: blocks of 4×4×4 cells are hashed, the cells of a block follow each other in Morton order, so that
/// what a query needs lies close together in memory. The lowest bits are the parities of the coordinates: the eight
/// cells of a query never share a bucket, and no vertex is met twice.
uint bucketOf(ivec3 cell) {
    uvec3 block = uvec3(cell >> 2), inner = uvec3(cell & 3);
    uint h = (block.x * 73856093u) ^ (block.y * 19349663u) ^ (block.z * 83492791u);
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    h ^= h >> 15;
    uvec3 spread = (inner & 1u) | ((inner & 2u) << 2);
    return ((h << 6) | spread.x | (spread.y << 1) | (spread.z << 2)) & (push.bucketCount - 1u);
}
#endif

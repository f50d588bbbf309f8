// The hash grid over light vertices: cubes a little larger than the merge diameter, so that a query meets at most 2×2×2.
#ifndef ANTIPODE_GRID
#define ANTIPODE_GRID

ivec3 cellOf(real3 position) { return ivec3(floor((position - job.gridOrigin.xyz) / push.cellSize)); }

/// Bucket of a cell. The lowest bits are the parities of the coordinates: the eight cells of a query never share a
/// bucket, so that no vertex is met twice.
uint bucketOf(ivec3 cell) {
    uvec3 c = uvec3(cell >> 1);
    uint h = (c.x * 73856093u) ^ (c.y * 19349663u) ^ (c.z * 83492791u);
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    h ^= h >> 15;
    uint parity = uint(cell.x & 1) | (uint(cell.y & 1) << 1) | (uint(cell.z & 1) << 2);
    return ((h << 3) | parity) & (push.bucketCount - 1u);
}
#endif

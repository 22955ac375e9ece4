/* floorf.c: for processors with an FPU that has a square root but no rounding to integers. */
float floorf(float x);

/* From 2^23 on every float is whole; NaN is returned unchanged. */
float floorf(float x)
{
    float whole;
    if (!(x > -8388608.0f && x < 8388608.0f))
        return x;
    whole = (float)(int)x;
    return whole == x ? x : whole < x ? whole : whole - 1.0f;
}

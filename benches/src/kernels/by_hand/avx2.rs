//! Five co-moments of 16 channels in AVX2.

super::comoments::comoments!(
    Avx2, BareAvx2, "avx2", 8,
    __m256: _mm256_setzero_ps _mm256_loadu_ps _mm256_storeu_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps,
    __m256d: _mm256_setzero_pd _mm256_set1_pd _mm256_loadu_pd _mm256_storeu_pd _mm256_add_pd _mm256_sub_pd _mm256_mul_pd,
    _mm256_cvtps_pd _mm_loadu_ps
);

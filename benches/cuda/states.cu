// States a second of generated kernels on the GPU that is here: torques, forward dynamics and its
// derivatives of the PUMA 560 and the Panda, in f64 and f32, with states and results in the GPU's
// memory. First the results are compared, bit for bit, with those of the same functions on the
// processor.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "panda.cuh"
#include "puma560.cuh"

static const size_t COUNTS[] = {1024, 16384, 1 << 20};
static const unsigned THREADS = 128;
static const int ROUNDS = 51;

static void check(cudaError_t error)
{
    if (error != cudaSuccess) {
        std::fprintf(stderr, "%s\n", cudaGetErrorString(error));
        std::exit(1);
    }
}

// Entries inside -3 to 3.
template <class T> static std::vector<T> entries(size_t count)
{
    unsigned long long seed = 1;
    std::vector<T> all(count);
    for (T &own : all) {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        own = T((double(seed >> 11) / double(1ULL << 53) - 0.5) * 6.0);
    }
    return all;
}

// `kernel(n, arguments, results)` launches, `host(arguments, results)` is of one state; so many
// arguments of J entries, and results of R in all.
template <class T, int J, int R, class Kernel, class Host>
static void row(const char *name, Kernel kernel, Host host)
{
    const size_t most = COUNTS[2];
    const std::vector<T> states = entries<T>(3 * J * most);
    T *in, *out;
    check(cudaMalloc(&in, states.size() * sizeof(T)));
    check(cudaMalloc(&out, R * most * sizeof(T)));
    check(cudaMemcpy(in, states.data(), states.size() * sizeof(T), cudaMemcpyHostToDevice));
    std::printf("%-34s", name);
    for (size_t n : COUNTS) {
        const unsigned blocks = unsigned((n + THREADS - 1) / THREADS);
        cudaEvent_t start, stop;
        check(cudaEventCreate(&start));
        check(cudaEventCreate(&stop));
        std::vector<float> times;
        for (int round = 0; round < ROUNDS; ++round) {
            check(cudaEventRecord(start));
            kernel(blocks, n, in, out);
            check(cudaGetLastError());
            check(cudaEventRecord(stop));
            check(cudaEventSynchronize(stop));
            float milliseconds;
            check(cudaEventElapsedTime(&milliseconds, start, stop));
            times.push_back(milliseconds);
        }
        std::sort(times.begin(), times.end());
        std::vector<T> found(R * n);
        check(cudaMemcpy(found.data(), out, found.size() * sizeof(T), cudaMemcpyDeviceToHost));
        size_t differ = 0;
        for (size_t s = 0; s < n && s < 1024; ++s) {
            T argument[3 * J], result[R];
            for (int i = 0; i < 3 * J; ++i) {
                argument[i] = states[i * n + s];
            }
            host(argument, result);
            for (int i = 0; i < R; ++i) {
                differ += found[i * n + s] != result[i];
            }
        }
        if (differ != 0) {
            std::fprintf(stderr, "\n%zu results are not the processor's\n", differ);
            std::exit(1);
        }
        const double seconds = times[ROUNDS / 2] * 1e-3;
        std::printf("  %9.3g (%7.2f ns)", double(n) / seconds, seconds / double(n) * 1e9);
    }
    std::printf("\n");
    check(cudaFree(in));
    check(cudaFree(out));
}

// Joint by joint a vector, or three matrices.
#define VECTOR(T, J, function, kernel)                                                            \
    row<T, J, J>(                                                                                 \
        #function " " #T,                                                                         \
        [](unsigned blocks, size_t n, T *in, T *out) {                                            \
            kernel<<<blocks, THREADS>>>(n, in, in + J * n, in + 2 * J * n, out);                  \
        },                                                                                        \
        [](const T *in, T *out) { function(in, in + J, in + 2 * J, out); })
#define MATRICES(T, J, function, kernel)                                                          \
    row<T, J, 3 * J * J>(                                                                         \
        #function " " #T,                                                                         \
        [](unsigned blocks, size_t n, T *in, T *out) {                                            \
            kernel<<<blocks, THREADS>>>(n, in, in + J * n, in + 2 * J * n, out, out + J * J * n,  \
                                        out + 2 * J * J * n);                                     \
        },                                                                                        \
        [](const T *in, T *out) {                                                                 \
            function(in, in + J, in + 2 * J, out, out + J * J, out + 2 * J * J);                  \
        })

int main()
{
    cudaDeviceProp device;
    check(cudaGetDeviceProperties(&device, 0));
    std::printf("%s: states a second, median of %d launches of %zu, %zu and %zu states\n",
                device.name, ROUNDS, COUNTS[0], COUNTS[1], COUNTS[2]);
    VECTOR(double, 6, puma560_inverse_dynamics, puma560_inverse_dynamics_batch);
    VECTOR(double, 6, puma560_forward_dynamics, puma560_forward_dynamics_batch);
    MATRICES(double, 6, puma560_fwd_dyn_deriv, puma560_fwd_dyn_deriv_batch);
    VECTOR(float, 6, puma560_f32_inverse_dynamics, puma560_f32_inv_dyn_batch);
    VECTOR(float, 6, puma560_f32_forward_dynamics, puma560_f32_fwd_dyn_batch);
    MATRICES(float, 6, puma560_f32_fwd_dyn_deriv, puma560_f32_fwd_dyn_deriv_batch);
    VECTOR(double, 7, panda_inverse_dynamics, panda_inverse_dynamics_batch);
    VECTOR(double, 7, panda_forward_dynamics, panda_forward_dynamics_batch);
    MATRICES(double, 7, panda_fwd_dyn_deriv, panda_fwd_dyn_deriv_batch);
    VECTOR(float, 7, panda_f32_inverse_dynamics, panda_f32_inv_dyn_batch);
    VECTOR(float, 7, panda_f32_forward_dynamics, panda_f32_fwd_dyn_batch);
    MATRICES(float, 7, panda_f32_fwd_dyn_deriv, panda_f32_fwd_dyn_deriv_batch);
    return 0;
}

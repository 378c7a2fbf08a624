#!/usr/bin/env python3
"""A search for processed splittings: kernels with small errors modulo conjugation, and their processors.

Input: the order (4 or 6), the number of stages of the kernel, the number of durations in the first half of the
processor, and seconds to search. Output: the best α of the kernel, a palindrome of a map and its adjoint, and
durations d₁ u₁ d₂ u₂ … of the processor; `coefficients.py` polishes both on their order conditions. Needs numpy
and scipy.

Words over two letters A and B stand for products of the two vector fields; a step is a series in them. By weight
n = 1, 2, … a Lie element ℓ of weight n − 1 in log π changes the error of weight n by [ℓ, A + B]. What no ℓ
removes is the error of the kernel modulo conjugation: zero up to the order, and as small as possible one weight
further (Euclidean norm over words). For a symmetric kernel log π is even. A processor whose durations are
followed by the same ones with −h has odd terms of high weight alone, so even weights are what is solved for:
exactly up to the order of the scheme, which takes the error of that weight to its least, and in the least squares
for two weights more (S. Blanes, F. Casas, A. Murua, SIAM J. Sci. Comput. 27, 1817, 2006).
"""

import itertools
import sys
import time
from functools import lru_cache

import numpy as np
from scipy.optimize import least_squares

# Weights of words are scaled by these powers of a step, so that small terms of high weight count.
SCALE = 6.0


def multiply(a, b, weight):
    """The part of one weight of a product of series, which are lists by weight."""
    return sum(np.outer(a[k], b[weight - k]).ravel() for k in range(weight + 1))


def series(durations, largest):
    """The words of the flows A(d₁) B(d₁ + u₁) A(u₁ + d₂) … up to a weight."""
    flat = np.concatenate([[0.0], durations, [0.0]])
    words = [np.array([1.0])] + [np.zeros(2**n) for n in range(1, largest + 1)]
    for stroke, duration in enumerate(flat[:-1] + flat[1:]):
        flow, coefficient = [np.array([1.0])], 1.0
        for n in range(1, largest + 1):
            coefficient *= duration / n
            flow.append(np.zeros(2**n))
            flow[n][-(stroke % 2)] = coefficient
        words = [multiply(words, flow, n) for n in range(largest + 1)]
    return words


def lyndon(n):
    """Lyndon words of a length over 0 and 1."""
    words = itertools.product((0, 1), repeat=n)
    return [w for w in words if all(w < w[i:] for i in range(1, n))]


@lru_cache(maxsize=None)
def bracket(word):
    """The bracket of a Lyndon word, as a sum of words."""
    if len(word) == 1:
        return np.eye(2)[word[0]]
    split = next(i for i in range(1, len(word)) if all(word[i:] < word[k:] for k in range(i + 1, len(word))))
    a, b = bracket(word[:split]), bracket(word[split:])
    return np.outer(a, b).ravel() - np.outer(b, a).ravel()


FIELD = np.ones(2)


@lru_cache(maxsize=None)
def shifts(n):
    """Lie elements of a weight as rows, and as columns what they change by [ℓ, A + B]; its inverse."""
    elements = np.array([bracket(w) for w in lyndon(n)])
    changes = np.array([np.outer(e, FIELD).ravel() - np.outer(FIELD, e).ravel() for e in elements]).T
    return elements, changes, np.linalg.pinv(changes)


def exponential(logs, weight):
    """The part of one weight of exp(Σ logs)."""
    total, power, factorial = np.zeros(2**weight), list(logs[: weight + 1]), 1.0
    for count in range(1, weight + 1):
        factorial *= count
        total += power[weight] / factorial
        power = [np.zeros(1)] + [multiply(power, logs, n) for n in range(1, weight + 1)]
    return total


def conjugate(kernel, largest):
    """The best processor as a series, and by weight what it leaves of the error."""
    step = series(kernel, largest)
    exact = [np.array([1.0])]
    for n in range(1, largest + 1):
        exact.append(np.outer(exact[-1], FIELD).ravel() / n)
    logs = [np.zeros(2**n) for n in range(largest + 1)]
    processor = [np.array([1.0])] + [np.zeros(2**n) for n in range(1, largest + 1)]
    errors = {}
    for n in range(2, largest + 1):
        processor[n - 1] = exponential(logs, n - 1)
        error = multiply(processor, exact, n) - multiply(step, processor, n)
        if n % 2 == 1:
            elements, changes, inverse = shifts(n - 1)
            chosen = -inverse @ error
            logs[n - 1] = elements.T @ chosen
            processor[n - 1] = processor[n - 1] + logs[n - 1]
            error = error + changes @ chosen
        errors[n] = error
    return processor, errors


def palindrome(free):
    alphas = np.append(free, 0.5 - free.sum())
    return np.concatenate([alphas, alphas[::-1]])


def find_kernel(order, stages, seconds, random):
    def residual(free):
        _, errors = conjugate(palindrome(free), order + 1)
        return np.concatenate([1e5 * errors[n] for n in range(3, order, 2)] + [30.0 * errors[order + 1]])

    best, began = (np.inf, None), time.time()
    while time.time() - began < seconds:
        start = random.normal(0.3 / stages, 0.25, stages - 1)
        free = least_squares(residual, start, max_nfev=100).x
        _, errors = conjugate(palindrome(free), order + 1)
        if max(np.abs(errors[n]).max() for n in range(3, order, 2)) < 1e-7:
            size = np.linalg.norm(errors[order + 1])
            if size < best[0]:
                best = (size, free)
                print(f"error {size:.3e}, effective {stages * size ** (1 / order):.4f}", file=sys.stderr)
    return palindrome(best[1])


def find_processor(order, kernel, count, seconds, random):
    largest = order + 2
    target = conjugate(kernel, largest + 1)[0]
    scale = np.concatenate([np.full(2**n, SCALE**n) for n in range(1, largest + 1)])
    exact = 2 ** (order + 1) - 2

    def durations(free):
        half = np.append(free, -free.sum())
        return np.concatenate([half, -half])

    def residual(free, rest, small):
        made = series(durations(free), largest)
        error = scale * np.concatenate([a - b for a, b in zip(made[1:], target[1:])])
        error[exact:] *= rest
        return np.append(error, small * free)

    best, began = (np.inf, None), time.time()
    while time.time() - began < seconds:
        free = random.normal(0.0, 0.12, count - 1)
        for rest, small in ((0, 1e-1), (0, 1e-2), (0, 1e-3), (1e-2, 0), (1e-3, 0), (0, 0)):
            free = least_squares(residual, free, args=(rest, small), max_nfev=40, xtol=1e-14, ftol=1e-14).x
        error = residual(free, 1.0, 0.0)
        if np.abs(error[:exact]).max() < 1e-9 and np.linalg.norm(error) < best[0]:
            best = (np.linalg.norm(error), free)
            print(f"two weights further: {best[0]:.3e}", file=sys.stderr)
    return durations(best[1])


if __name__ == "__main__":
    order, stages, count, seconds = (int(word) for word in sys.argv[1:5])
    random = np.random.default_rng(1)
    kernel = find_kernel(order, stages, seconds, random)
    print("kernel", kernel[:stages].tolist())
    print("processor", find_processor(order, kernel, count, seconds, random)[:count].tolist())

"""The statistics of steady states worked out once more, from the definitions in the literature and with
the tools of numpy and scipy: kept numbers that the engine's are compared with.

    python3 steady_states.py            # rewrites series.csv and statistics.csv
    python3 steady_states.py --check    # recomputes and compares; exit status 1 on a difference

It shares no line with engine/time_series.cpp and works in other ways: MSER-5 tries every cut, the
autocorrelation comes from an FFT, the cosines from a discrete cosine transform, Student's points from
scipy, the line from scipy's regression. A mistake there therefore shows as a difference."""

import argparse
import pathlib
import sys

import numpy as np
import scipy.fft
from scipy import signal, stats

HERE = pathlib.Path(__file__).resolve().parent
SAMPLES = 600
COSINES = 8
MIN_INDEPENDENT = 20
STUDENT_68 = stats.t.ppf(0.5 + 0.682689492 / 2, COSINES)
STUDENT_99 = stats.t.ppf(0.995, COSINES)


# --- the series ---

def autoregressive(random, phi):
    """Stationary, of mean 0 and variance 1: x_i = phi x_(i-1) + noise."""
    noise = random.normal(size=SAMPLES) * np.sqrt(1 - phi**2)
    noise[0] = random.normal()
    return signal.lfilter([1], [1, -phi], noise)


def make_series():
    """{name: samples}, rounded to what the file holds."""
    random = np.random.default_rng(20240229)
    passed = np.arange(SAMPLES) / SAMPLES
    series = {f"ar1_{phi}": 10 + autoregressive(random, phi) for phi in (0.0, 0.5, 0.9, 0.99)}
    series["approach"] = 1 - np.exp(-12 * passed) + 0.05 * autoregressive(random, 0.5)
    series["early"] = 1 - np.exp(-5 * passed) + 0.02 * autoregressive(random, 0.5)
    series["decay"] = 1 + 2 * np.exp(-2 * passed) + 0.05 * autoregressive(random, 0.8)
    series["fall"] = 1 + 5 * passed + 0.1 * autoregressive(random, 0.8)
    series["quiet_line"] = 100 + 0.6 * passed + 0.3 * autoregressive(random, 0.3)
    series["walk"] = 50 + np.cumsum(random.normal(size=SAMPLES))
    return {name: np.round(samples, 4) for name, samples in series.items()}


# --- the definitions ---

def mser5(series):
    """White, Cobb and Spratt 2000: the cut, in the first half, with the least marginal standard error of
    the means of five; the earliest of equals."""
    batches = series[:len(series) // 5 * 5].reshape(-1, 5).mean(axis=1)
    count = len(batches)
    errors = [np.sum((batches[cut:] - batches[cut:].mean())**2) / (count - cut)**2
              for cut in range(count // 2 + 1)]
    return 5 * int(np.argmin(errors))


def autocorrelation(series):
    """rho_0, rho_1, ...: the biased estimate, by way of the periodogram."""
    deviations = series - series.mean()
    spectrum = np.abs(np.fft.rfft(deviations, 2 * len(series)))**2
    covariance = np.fft.irfft(spectrum)[:len(series)]
    return covariance / covariance[0]


def windowed_time(series):
    """Sokal's self-consistent window: the first lag M >= 2.5 tau(M), at most a fifth of the series;
    corrected for the subtracted mean as in Wolff 2004."""
    n = len(series)
    times = 2 * np.cumsum(autocorrelation(series)) - 1
    lags = np.arange(n // 5 + 1)
    closed = np.flatnonzero(lags >= 2.5 * times[:len(lags)])
    window = closed[0] if len(closed) else n // 5
    return times[window] * (1 + (2 * window + 1) / n)


def long_run_variance(deviations, first):
    """Mueller 2014: the mean square of eight cosine transforms."""
    coefficients = scipy.fft.dct(deviations, type=2, norm="ortho")
    return np.mean(coefficients[first:first + COSINES]**2)


def integrated_time(deviations, first):
    return max(1.0, long_run_variance(deviations, first) / np.var(deviations),
               windowed_time(deviations))


def estimate_mean(series):
    """(mean, error, autocorrelation time)"""
    n = len(series)
    deviations = series - series.mean()
    time = integrated_time(deviations, 1)
    error = STUDENT_68 * np.sqrt(long_run_variance(deviations, 1) / n) * (1 + 6 * time / n)
    return series.mean(), error, time


def estimate_trend(series):
    """(slope, error): the error of least squares under the long-run variance of the residuals; where
    those cannot be told from a random walk, at least that of a walk's slope, whose variance is
    6/5 w/n (Durlauf and Phillips 1988). The steps between block means have 2/3 w times the block."""
    n = len(series)
    time = np.arange(n)
    line = stats.linregress(time, series)
    residuals = series - line.intercept - line.slope * time
    error = np.sqrt(long_run_variance(residuals, 2) / np.sum((time - time.mean())**2))
    if n / integrated_time(residuals, 2) < MIN_INDEPENDENT:
        block = n // 10
        means = residuals[:10 * block].reshape(10, block).mean(axis=1)
        walk = 1.5 * np.var(np.diff(means), ddof=1) / block
        error = max(error, np.sqrt(1.2 * walk / n))
    return line.slope, STUDENT_68 * error


def assess(series):
    """The verdict of docs/statistics.md, without a value of gravity."""
    n = len(series)
    cut = mser5(series)
    arrived = cut <= 2 / 5 * n
    end = 2 * cut if arrived else cut
    start = min(end, n // 2)
    mean, error, time = estimate_mean(series[end:])
    slope, slope_error = estimate_trend(series[start:])
    if abs(slope) > STUDENT_99 / STUDENT_68 * slope_error:
        gain = slope * (n - start)
        verdict = "accelerating" if gain > 0 and gain >= 0.1 * abs(mean) else "drifting"
    elif not arrived or (n - end) / time < MIN_INDEPENDENT:
        verdict = "too_short"
    else:
        verdict = "steady"
    return {"verdict": verdict, "transient_end": end, "state_mean": mean, "state_error": error,
            "state_time": time, "trend": slope, "trend_error": slope_error}


def statistics_of(name, series):
    mean, error, time = estimate_mean(series)
    slope, slope_error = estimate_trend(series)
    return {"series": name, "transient": mser5(series), "mean": mean, "error": error, "time": time,
            "slope": slope, "slope_error": slope_error, **assess(series)}


# --- the files ---

def series_text(series):
    lines = ["# Series whose statistics are in statistics.csv; made by steady_states.py.",
             ",".join(series)]
    lines += [",".join(f"{sample:.4f}" for sample in row) for row in zip(*series.values())]
    return "\n".join(lines) + "\n"


def statistics_text(series):
    rows = [statistics_of(name, samples) for name, samples in series.items()]
    lines = ["# Statistics of the series in series.csv; made by steady_states.py. Times in samples.",
             "# transient ... slope_error: of the whole series; verdict ... trend_error: of the state.",
             ",".join(rows[0])]
    lines += [",".join(f"{cell:.15g}" if isinstance(cell, float) else str(cell) for cell in row.values())
              for row in rows]
    return "\n".join(lines) + "\n"


def cells(text):
    """Numbers and words of a table, one after the other."""
    words = ",".join(line for line in text.splitlines() if not line.startswith("#")).split(",")
    return words


def same(one, other):
    try:
        return np.isclose(float(one), float(other), rtol=1e-8, atol=1e-12)
    except ValueError:
        return one == other


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    series = make_series()
    files = {"series.csv": series_text(series), "statistics.csv": statistics_text(series)}
    status = 0
    for name, text in files.items():
        path = HERE / name
        if not check:
            path.write_text(text, encoding="utf-8")
            continue
        kept = cells(path.read_text(encoding="utf-8"))
        if len(kept) != len(cells(text)) or not all(map(same, kept, cells(text))):
            print(f"{name} differs", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())

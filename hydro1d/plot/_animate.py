"""The run as a film: GIF, or MP4 where ffmpeg is."""

import os
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from hydro1d.errors import DeckError, Hydro1dError, file_problems
from hydro1d.plot._base import PALETTE, new_figure
from hydro1d.plot._data import RunOrPath, as_run, heading, profile_quantity, scaled, times_of
from hydro1d.plot._frames import along, check_frame, length_label, length_scale
from hydro1d.plot._profiles import QUANTITIES
from hydro1d.plot._units import scale_for
from hydro1d.store import Run

ENDINGS = (".gif", ".mp4")


def animate(
    run: RunOrPath,
    path: str | os.PathLike[str],
    quantities: Sequence[str] = QUANTITIES,
    frame: str = "lagrangian",
    frames: int = 100,
    fps: int = 15,
    dpi: int = 90,
) -> Path:
    """Write a film of the profiles, at most `frames` of them, `fps` a second; the ending says which kind.

    Raises DeckError for another ending, Hydro1dError if an MP4 is asked for and there is no ffmpeg, FileProblem.
    """
    run, target = as_run(run), Path(path)
    if target.suffix.lower() not in ENDINGS:
        raise DeckError(f"{target}: a film's name ends in {' or '.join(ENDINGS)}")
    if target.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise Hydro1dError("an MP4 needs the program ffmpeg, which is not found; name a .gif instead")
    if frames < 1 or fps < 1:
        raise DeckError("frames and fps must be 1 at least")
    check_frame(frame)
    stored = len(times_of(run, 2))
    chosen = sorted({round(k) for k in np.linspace(0, stored - 1, min(frames, stored))})
    with file_problems("write", target):
        _write(_Scene(run, quantities, frame), target, chosen, fps, dpi)
    return target


class _Scene:
    """Axes with fixed limits and lines that move."""

    def __init__(self, run: Run, quantities: Sequence[str], frame: str) -> None:
        self.run, self.quantities, self.frame = run, quantities, frame
        self.figure, axes = new_figure(len(quantities), 1, (7.0, 0.9 + 1.9 * len(quantities)), sharex=True)
        self.canvas = FigureCanvasAgg(self.figure)
        self.lines, self.scales = [], []
        for one, quantity in zip(axes[:, 0], quantities, strict=True):
            values = profile_quantity(run, quantity)
            finite = values[np.isfinite(values)] if np.isfinite(values).any() else np.zeros(1)
            scale, label = scaled(run, quantity)
            low, high = (float(bound) / scale.size for bound in np.percentile(finite, (0.5, 99.9)))
            margin = 0.06 * (high - low) or 1.0
            one.set_ylim(low - margin, high + margin)
            one.set_ylabel(label)
            self.lines += one.plot([], [], color=PALETTE[0], linewidth=1.3)
            self.scales.append(scale)
        nodes = run["node_coordinate"] if frame == "lagrangian" else run["position"]
        axes[-1, 0].set_xlim(*(float(end(nodes)) / length_scale(run).size for end in (np.nanmin, np.nanmax)))
        axes[-1, 0].set_xlabel(length_label(run, frame))
        self.figure.suptitle(heading(run), fontsize=11)
        self.clock = axes[0, 0].set_title("", fontsize=9, loc="right")

    def show(self, index: int) -> None:
        """Move to one profile."""
        for line, scale, quantity in zip(self.lines, self.scales, self.quantities, strict=True):
            x = along(self.run, quantity, index, self.frame) / length_scale(self.run).size
            line.set_data(x, self.run[quantity][index] / scale.size)
        time = scale_for("s", self.run.time)
        self.clock.set_text(f"t = {self.run.time[index] / time.size:.3f} {time.unit}")


def _write(scene: _Scene, target: Path, chosen: Sequence[int], fps: int, dpi: int) -> None:
    from matplotlib.animation import FFMpegWriter

    if target.suffix.lower() == ".gif":
        _write_gif(scene, target, chosen, fps, dpi)
        return
    writer = FFMpegWriter(fps=fps)
    with writer.saving(scene.figure, str(target), dpi):
        for index in chosen:
            scene.show(index)
            writer.grab_frame()


def _write_gif(scene: _Scene, target: Path, chosen: Sequence[int], fps: int, dpi: int) -> None:
    """All frames with one palette of few colours: small files, no flicker."""
    from PIL import Image

    scene.figure.set_dpi(dpi)
    pages = []
    for index in chosen:
        scene.show(index)
        scene.canvas.draw()
        pages.append(Image.fromarray(np.asarray(scene.canvas.buffer_rgba())[..., :3].copy()))
        if len(pages) == 1:  # the layout is found once; later frames must not jitter
            scene.figure.set_layout_engine("none")
    palette = pages[len(pages) // 2].quantize(64)
    first, *rest = [page.quantize(palette=palette, dither=Image.Dither.NONE) for page in pages]
    first.save(
        target, format="GIF", save_all=True, append_images=rest, duration=round(1000 / fps), loop=0, optimize=False
    )

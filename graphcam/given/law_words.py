"""What else the motion laws are called, by textbooks in several languages: a message names the law that is meant."""

from collections.abc import Mapping

LAW_WORDS: Mapping[str, tuple[str, ...]] = {
    "rectangular": (
        *("constant acceleration", "uniform acceleration", "parabolic", "parabola"),
        *("прямоугольный (постоянного ускорения)", "прямоугольный", "постоянного ускорения", "параболический"),
        *("gia tốc không đổi", "等加速等减速", "等加速"),
    ),
    "triangular": ("треугольный", "tam giác", "三角形加速度"),
    "cosine": (
        *("simple harmonic", "simple harmonic motion", "SHM", "harmonic", "cosine acceleration"),
        *("косинусоидальный", "косинусный", "гармонический", "cosin", "điều hòa"),
        *("余弦加速度", "余弦加速度(简谐)", "余弦", "简谐", "简谐运动"),
    ),
    "cycloidal": (
        *("cycloid", "sine", "sine acceleration", "sinusoidal"),
        *("синусоидальный", "синусный", "циклоидальный", "xyclôit", "sin", "正弦加速度", "正弦", "摆线"),
    ),
    "trapezoidal": ("trapezoid", "трапецеидальный", "трапециевидный", "hình thang", "梯形加速度", "梯形"),
    "modified-trapezoidal": (
        "modtrap",
        "mod-trapezoid",
        "MT",
        "видоизменённый трапецеидальный",
        "hình thang cải tiến",
        "改进梯形",
        "修正梯形",
    ),
    "modified-sine": (
        "modsine",
        "mod-sine",
        "MS",
        "видоизменённый синусоидальный",
        "sin cải tiến",
        "改进正弦",
        "修正正弦",
    ),
    "2-3": ("cubic", "полином 2-3", "đa thức 2-3", "2-3 多项式"),
    "3-4-5": ("quintic", "polynomial 3-4-5", "полином 3-4-5", "đa thức 3-4-5", "3-4-5 多项式", "五次多项式"),
    "4-5-6-7": ("polynomial 4-5-6-7", "полином 4-5-6-7", "đa thức 4-5-6-7", "4-5-6-7 多项式", "七次多项式"),
    "double-harmonic": ("двойной гармонический", "điều hòa kép", "双简谐"),
    "eighth-degree": ("полином восьмой степени", "đa thức bậc tám", "八次多项式"),
    "constant-velocity": ("uniform velocity", "постоянная скорость", "vận tốc không đổi", "等速"),
}
"""Other names of the laws by the law's name; those of the catalogs among them."""

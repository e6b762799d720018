"""The colours of the figures."""

BLUE, RED, GREEN, ORANGE = "#1f5fa8", "#c0392b", "#2e8b57", "#e08a00"
PURPLE, GREY, BROWN, GOLD, PINK, LILAC = "#7d3c98", "#777777", "#8b5a2b", "#d9b648", "#d98cb3", "#b9a3d4"

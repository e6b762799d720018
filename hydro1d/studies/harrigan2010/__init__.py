"""Figures and numbers of Harrigan, Reid & Seyed Yaghoubi 2010, doi:10.1016/j.ijimpeng.2009.03.011, by the solver."""

/* Coefficients of the implicit Runge-Kutta method Radau IIA of 5 stages: order 9, stage order 5,
 * L-stable, stiffly accurate. E. Hairer, G. Wanner, Stiff differential equations solved by Radau
 * methods, J. Comput. Appl. Math. 111, 1999, p. 93. Numbers only, found from its nodes with 50
 * digits and printed to the last bit of a double.
 *
 * With the matrix A of the method, T^-1 A^-1 T is made of ra_gamma and the blocks
 * {{a, -b}, {b, a}} of ra_a and ra_b, so that a system of the five stages splits into one real and
 * two complex ones of the size of one stage. */
#ifndef FROT_RADAU_TABLE_H
#define FROT_RADAU_TABLE_H

#define RA_STAGES 5
#define RA_PAIRS 2
#define RA_BETWEEN 2
#define RA_VECTORS 7

/* Nodes. */
static const double ra_c[RA_STAGES] = {0.05710419611451768, 0.2768430136381238, 0.5835904323689168,
                                       0.8602401356562195, 1.0};

/* What the stages have moved by their slopes: Z = h A F. */
static const double ra_A[RA_STAGES][RA_STAGES] = {
    {0.07299886431790333, -0.02673533110794557, 0.018676929763984353, -0.01287910609330644,
     0.005042839233882015},
    {0.15377523147918246, 0.14621486784749352, -0.03644456890512809, 0.02123306311930472,
     -0.007935579902728777},
    {0.14006304568480987, 0.29896712949128346, 0.16758507013524895, -0.03396910168661774,
     0.010944288744192253},
    {0.14489430810953477, 0.2765000687601592, 0.32579792291042103, 0.12875675325490976,
     -0.015708917378805327},
    {0.14371356079122594, 0.28135601514946207, 0.31182652297574126, 0.22310390108357075, 0.04},
};

static const double ra_gamma = 6.2867047517292765;
static const double ra_a[RA_PAIRS] = {3.655694325463572, 5.70095329867179};
static const double ra_b[RA_PAIRS] = {6.543736899360077, 3.2102656003085497};

static const double ra_T[RA_STAGES][RA_STAGES] = {
    {0.012517586220501045, -0.010242047817908826, 0.04767387729029572, -0.011478515255229515,
     -0.01401985889287541},
    {0.0014916701518953824, 0.05017286451737106, -0.09433181918161143, -0.007668830749180163,
     0.024708578426518527},
    {0.07298187638808715, -0.23053953404341795, 0.1027030453801259, 0.01939846399882895,
     0.08180035370375117},
    {0.3800914400035681, 0.37789390224886127, 0.46674413033249434, 0.40760117128019907,
     0.19968242788680252},
    {0.9219789736812105, 1.0, 0.0, 1.0, 0.0},
};

static const double ra_TI[RA_STAGES][RA_STAGES] = {
    {30.0415677215444, 13.865107856271413, 3.4800027747951856, -1.0320087978252634,
     0.8043030450739899},
    {5.344186437834912, 4.593615567759161, -3.0363603234594243, 1.050660190231459,
     -0.27277861186429625},
    {3.748059807439805, -3.984965736343885, -1.0444156416080188, 1.1840985681379486,
     -0.44991777015678036},
    {-33.041880213519, -17.376953479063566, -0.17212906325400557, -0.09916977798254265,
     0.5312281158383066},
    {-8.611443979875292, 9.699991409528808, 1.9147286396968743, 2.41869200608494,
     -1.0474634879353375},
};

/* The estimate of the error of order 5 is (ra_gamma I / h - J)^-1 (f + ra_gamma / h sum e_i Z_i), f
 * the slope at the start and Z_i what the stages have moved. */
static const double ra_e[RA_STAGES] = {-4.418997716796381, 0.57923485225667, -0.199237560953468,
                                       0.09416748369194548, -0.03181316888549383};

/* Places between the stages, the polynomial through the Z_i and h times its rate there. */
static const double ra_between[RA_BETWEEN] = {0.43, 0.73};
static const double ra_value[RA_BETWEEN][RA_STAGES] = {
    {-0.4958389250202608, 0.7671631887191346, 0.5546915259899694, -0.13795773624884328,
     0.04089482836},
    {0.3404356333146267, -0.32124073107806406, 0.7209430404343896, 0.5646337827690477,
     -0.10696315364},
};
static const double ra_rate[RA_BETWEEN][RA_STAGES] = {
    {0.8601128577664539, -4.282455209906301, 4.136819877787831, -0.4513060856479843, 0.11047486},
    {-0.33194852874698155, 0.5447267706417427, -4.55571867031443, 4.623881468419669, -0.45082274},
};
/* What the rate misses there, integrated from the start, in what it misses there, of a motion that
 * is not stiff: its error is the polynomial that is zero at the nodes. */
static const double ra_left[RA_BETWEEN] = {-0.0038384397366376427, -0.023363618112933568};

/* Vectors of the dense output by the Z_i: x + theta (f_0 + (1 - theta) (f_1 + theta (f_2 + ...))).
 */
static const double ra_dense[RA_STAGES][RA_STAGES] = {
    {0.0, 0.0, 0.0, 0.0, 1.0},
    {27.78093394406464, -3.641478498049213, 1.2525477211691187, -0.5920031671845428, -0.8},
    {-36.19335816765893, 10.611734614705874, -10.029661925319592, 18.811285478272644, -11.2},
    {-144.05356518917776, 63.63016294236274, -17.885204671340986, -5.291393081843982, 5.6},
    {199.88739542347736, -127.022853068795, 92.10283313613321, -64.16737549081559, 25.2},
};

/* And by what is added at the places between. */
static const double ra_bubble[RA_VECTORS][RA_BETWEEN] = {
    {0.0, 0.0},
    {20.877974155425537, 9.926113422526127},
    {-59.487926360664545, -75.71546982764116},
    {-470.1834179660217, -185.59523701653504},
    {1017.0147410505919, 1014.7719675680199},
    {1829.825734882364, 604.3387195389163},
    {-3603.5955391556404, -2908.5820726471907},
};

#endif

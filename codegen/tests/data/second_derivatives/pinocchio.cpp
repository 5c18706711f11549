// Reads a chain and states, and writes the second derivatives of its torques, tensors of n³
// numbers: by q and q, by q̇ and q̇, by q and q̇, by q̈ and q.
#include <iostream>
#include <pinocchio/algorithm/rnea-second-order-derivatives.hpp>

template <class Matrix> Matrix read(int rows, int columns)
{
    Matrix matrix(rows, columns);
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < columns; k++)
            std::cin >> matrix(i, k);
    return matrix;
}

int main()
{
    using namespace pinocchio;
    std::cout.precision(17);
    int n, states, parent = 0;
    std::cin >> n >> states;
    Model model;
    model.gravity.linear() = read<Eigen::MatrixXd>(3, 1);
    for (int i = 0; i < n; i++) {
        int slides;
        std::cin >> slides;
        Eigen::Matrix3d rotation = read<Eigen::MatrixXd>(3, 3);
        Eigen::Vector3d offset = read<Eigen::MatrixXd>(3, 1);
        SE3 place(rotation, offset);
        double mass = read<Eigen::MatrixXd>(1, 1)(0, 0);
        Eigen::Vector3d com = read<Eigen::MatrixXd>(3, 1);
        Eigen::Matrix3d tensor = read<Eigen::MatrixXd>(3, 3);
        std::string name = "joint" + std::to_string(i);
        parent = slides ? model.addJoint(parent, JointModelPZ(), place, name)
                        : model.addJoint(parent, JointModelRZ(), place, name);
        model.appendBodyToJoint(parent, Inertia(mass, com, tensor), SE3::Identity());
    }
    for (int s = 0; s < states; s++) {
        Eigen::VectorXd q = read<Eigen::MatrixXd>(n, 1), v = read<Eigen::MatrixXd>(n, 1);
        Eigen::VectorXd a = read<Eigen::MatrixXd>(n, 1);
        Data data(model);
        ComputeRNEASecondOrderDerivatives(model, data, q, v, a);
        for (auto *tensor : {&data.d2tau_dqdq, &data.d2tau_dvdv, &data.d2tau_dqdv, &data.d2tau_dadq})
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++)
                    for (int k = 0; k < n; k++)
                        std::cout << (*tensor)(i, j, k) << ' ';
        std::cout << '\n';
    }
}
